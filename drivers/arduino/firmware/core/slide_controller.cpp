#include "slide_controller.hpp"

namespace plugpilot {
namespace {

constexpr int32_t kOneQ8 = 256;

// Errors beyond this saturate the PWM anyway; the bound keeps products within 32 bits.
constexpr int32_t kLargestErrorQ8 = 32767;

int32_t clamped(int32_t value, int32_t limit) {
  if (value > limit) return limit;
  if (value < -limit) return -limit;
  return value;
}

int32_t clamped_error(int64_t value) {
  if (value > kLargestErrorQ8) return kLargestErrorQ8;
  if (value < -kLargestErrorQ8) return -kLargestErrorQ8;
  return static_cast<int32_t>(value);
}

int32_t sign(int32_t value) { return (value > 0) - (value < 0); }

// [2^-31 counts/tick] to [2^-8 counts/ms]
int32_t speed_q8(int32_t rate) {
  return static_cast<int32_t>((static_cast<int64_t>(rate) * (protocol::TICK_HZ / 1000)) >>
                              (protocol::PHASE_BITS - 8));
}

}  // namespace

void SlideController::configure(const protocol::ConfigRho3& numbers) {
  numbers_ = numbers;
  force_limit_dn_ = numbers.force_limit_dn;
  reset();
}

void SlideController::reset() {
  integral_q16_ = force_q8_ = 0;
  stuck_ms_ = 0;
  pwm_ = 0;
  limited_ = false;
}

int32_t SlideController::wanted_q8(int32_t error_q8, int32_t speed_error_q8) const {
  const int64_t proportional = static_cast<int64_t>(numbers_.kp_q8) * error_q8 / kOneQ8;
  const int64_t damping = static_cast<int64_t>(numbers_.kd_q8) * speed_error_q8 / kOneQ8;
  const int64_t sum = proportional + damping + integral_q16_ / kOneQ8;
  const int32_t most_q8 = kPwmMax * kOneQ8;
  if (sum > most_q8) return most_q8;
  if (sum < -most_q8) return -most_q8;
  return static_cast<int32_t>(sum);
}

// Not while the cap holds the output and the error pulls further: the integral would wind up.
void SlideController::integrate(int32_t error_q8, int32_t wanted_q8, int32_t cap_q8) {
  if ((wanted_q8 >= cap_q8 && error_q8 > 0) || (wanted_q8 <= -cap_q8 && error_q8 < 0)) return;
  const int32_t most_q16 = static_cast<int32_t>(numbers_.integral_pwm_max) * kOneQ8 * kOneQ8;
  const int64_t sum =
      integral_q16_ + static_cast<int64_t>(numbers_.ki_q16) * error_q8 / kOneQ8;
  integral_q16_ = sum > most_q16    ? most_q16
                  : sum < -most_q16 ? -most_q16
                                    : static_cast<int32_t>(sum);
}

void SlideController::watch_for_stall(int32_t counts) {
  if (counts != last_counts_ || !limited_) {
    stuck_ms_ = 0;
  } else if (stuck_ms_ < UINT16_MAX) {
    ++stuck_ms_;
  }
  last_counts_ = counts;
}

int16_t SlideController::update(int64_t set_point, int32_t rate, const Encoder& encoder) {
  // half a count is what the encoder does not show
  const int64_t measured_q8 = static_cast<int64_t>(encoder.counts()) * kOneQ8 + kOneQ8 / 2;
  const int32_t error_q8 =
      clamped_error((set_point >> (protocol::PHASE_BITS - 8)) - measured_q8);
  const int32_t moved_q8 = encoder.speed_q8();
  const int32_t speed_error_q8 = clamped_error(static_cast<int64_t>(speed_q8(rate)) - moved_q8);

  const int64_t cap64_q8 = static_cast<int64_t>(force_limit_dn_) * numbers_.pwm_per_newton_q8 / 10;
  const int32_t cap_q8 =
      cap64_q8 < kPwmMax * kOneQ8 ? static_cast<int32_t>(cap64_q8) : kPwmMax * kOneQ8;
  const int32_t wanted = wanted_q8(error_q8, speed_error_q8);
  integrate(error_q8, wanted, cap_q8);
  force_q8_ = clamped(wanted, cap_q8);

  // friction works against the wanted motion, or at rest against what the error asks for
  const int32_t settled_q8 = static_cast<int32_t>(numbers_.settled) * kOneQ8;
  const bool arrived = rate == 0 && error_q8 <= settled_q8 && error_q8 >= -settled_q8;
  const int32_t direction = rate != 0 ? sign(rate) : arrived ? 0 : sign(error_q8);
  const int32_t unforced_q8 =
      direction * numbers_.friction_pwm * kOneQ8 +
      static_cast<int32_t>(static_cast<int64_t>(numbers_.back_emf_q8) * moved_q8 / kOneQ8);
  const int32_t most_q8 = kPwmMax * kOneQ8;
  const int32_t total_q8 = force_q8_ + unforced_q8;
  limited_ = wanted >= cap_q8 || wanted <= -cap_q8 || total_q8 > most_q8 || total_q8 < -most_q8;
  force_q8_ += clamped(total_q8, most_q8) - total_q8;
  pwm_ = static_cast<int16_t>(clamped(total_q8, most_q8) / kOneQ8);
  watch_for_stall(encoder.counts());
  return pwm_;
}

int16_t SlideController::force_dn() const {
  if (numbers_.pwm_per_newton_q8 == 0) return 0;
  return static_cast<int16_t>(static_cast<int64_t>(force_q8_) * 10 / numbers_.pwm_per_newton_q8);
}

}  // namespace plugpilot
