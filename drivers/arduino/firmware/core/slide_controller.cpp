#include "slide_controller.hpp"

namespace plugpilot {
namespace {

constexpr int32_t kOneQ8 = 256;
constexpr int32_t kMostQ8 = kPwmMax * kOneQ8;

// Larger errors and speeds saturate the PWM anyway; times a gain of 16 bits this stays in 32 bits.
constexpr int32_t kLargestQ8 = 32767;

constexpr int32_t kLetGoShare = 4;  // of the integral, for each count
constexpr int32_t kTightShare = 4;  // of the cap is left at most when the slide pushes itself tight

int32_t clamped(int32_t value, int32_t limit) {
  if (value > limit) return limit;
  if (value < -limit) return -limit;
  return value;
}

int32_t sign(int32_t value) { return (value > 0) - (value < 0); }

// gain [2^-8] times value [2^-8]; a shift, because dividing is slow here
int32_t scaled(uint16_t gain_q8, int32_t value_q8) {
  return static_cast<int32_t>(gain_q8) * clamped(value_q8, kLargestQ8) >> 8;
}

// [2^-31 counts/tick] to [2^-8 counts/ms]
int32_t speed_q8(int32_t rate) {
  // by 2^15 in two steps: doubled, then by whole bytes, which is quick here
  const int32_t per_ms = (rate >> 8) * (protocol::TICK_HZ / 1000);
  static_assert(protocol::PHASE_BITS == 31 && protocol::TICK_HZ <= 64000, "fits into 32 bits");
  return per_ms * 2 >> 16;
}

}  // namespace

void SlideController::configure(const protocol::ConfigRho3& numbers) {
  numbers_ = numbers;
  limit_force(numbers.force_limit_dn);
  reset();
}

void SlideController::reset() {
  integral_q16_ = force_q8_ = last_rate_ = 0;
  stuck_ms_ = 0;
  pwm_ = 0;
  limited_ = holding_ = tight_ = false;
  stood_ms_ = 0;
}

void SlideController::limit_force(uint16_t force_dn) {
  const uint32_t cap_q8 = static_cast<uint32_t>(force_dn) * numbers_.pwm_per_newton_q8 / 10;
  cap_q8_ = cap_q8 < static_cast<uint32_t>(kMostQ8) ? static_cast<int32_t>(cap_q8) : kMostQ8;
}

int32_t SlideController::wanted_q8(int32_t error_q8, int32_t speed_error_q8) const {
  return clamped(scaled(numbers_.kp_q8, error_q8) + scaled(numbers_.kd_q8, speed_error_q8) +
                     (integral_q16_ >> 8),
                 kMostQ8);
}

// At rest and near enough: dry friction and the screw hold the slide without further efforts. Where
// it has arrived it may be a little further away before it is moved again, or it would creep about
// its place for ever. If it moves all the same, the integral pushes too much.
bool SlideController::leaves_alone(int32_t error_q8, int32_t rate, bool moved) {
  const auto is_within = [error_q8](uint16_t counts) {
    return clamped(error_q8, static_cast<int32_t>(counts) << 8) == error_q8;
  };
  const bool within = rate == 0 && is_within(numbers_.settled);
  if (!within || moved) {
    stood_ms_ = 0;
  } else if (stood_ms_ < protocol::ARRIVED_MS) {
    ++stood_ms_;
  }
  holding_ = rate == 0 && is_within(numbers_.near) &&
             (holding_ || stood_ms_ == protocol::ARRIVED_MS);
  if (holding_ && moved) integral_q16_ -= integral_q16_ / kLetGoShare;
  return within || holding_;
}

// What the slide pushes against hinders one direction only, because the screw locks itself. So what
// the integral has learnt is wrong for the other: when the set point turns round, and when the
// slide at rest has gone past its place. Otherwise it would swing about that place for ever.
void SlideController::forget_other_direction(int32_t error_q8, int32_t rate) {
  const int32_t wanted = rate != 0 ? sign(rate) : sign(error_q8);
  const bool turned = rate == 0 || sign(rate) != sign(last_rate_);
  if (turned && wanted * sign(integral_q16_) < 0) integral_q16_ = 0;
  last_rate_ = rate;
}

// Not while the cap holds the output and the error pulls further: the integral would wind up.
void SlideController::integrate(int32_t error_q8, int32_t wanted_q8) {
  if ((wanted_q8 >= cap_q8_ && error_q8 > 0) || (wanted_q8 <= -cap_q8_ && error_q8 < 0)) return;
  const int32_t most_q16 = static_cast<int32_t>(numbers_.integral_pwm_max) << 16;
  integral_q16_ = clamped(integral_q16_ + scaled(numbers_.ki_q16, error_q8), most_q16);
}

void SlideController::watch_for_stall(int32_t counts) {
  if (counts != last_counts_) {
    const int32_t force_q8 = force_q8_ < 0 ? -force_q8_ : force_q8_;
    tight_ = force_q8 >= cap_q8_ - cap_q8_ / kTightShare;
  }
  if (counts != last_counts_ || !limited_) {
    stuck_ms_ = 0;
  } else if (stuck_ms_ < UINT16_MAX) {
    ++stuck_ms_;
  }
  last_counts_ = counts;
}

int16_t SlideController::update(int64_t set_point, int32_t rate, const Encoder& encoder) {
  // in the middle of its count: what is within, the encoder does not show
  const int32_t measured_q8 = (encoder.counts() * kOneQ8) + kOneQ8 / 2;
  const int32_t error_q8 = whole_part_q8(set_point) - measured_q8;
  const int32_t moved_q8 = encoder.speed_q8();
  const bool arrived = leaves_alone(error_q8, rate, encoder.counts() != last_counts_);
  if (!arrived) forget_other_direction(error_q8, rate);
  const int32_t wanted = wanted_q8(error_q8, speed_q8(rate) - moved_q8);
  if (!arrived) integrate(error_q8, wanted);
  force_q8_ = clamped(wanted, cap_q8_);

  // friction works against the wanted motion, or at rest against what the error asks for
  const int32_t direction = rate != 0 ? sign(rate) : arrived ? 0 : sign(error_q8);
  const int32_t total_q8 = force_q8_ + direction * numbers_.friction_pwm * kOneQ8 +
                           scaled(numbers_.back_emf_q8, moved_q8);
  const int32_t possible_q8 = clamped(total_q8, kMostQ8);
  limited_ = wanted >= cap_q8_ || wanted <= -cap_q8_ || possible_q8 != total_q8;
  force_q8_ += possible_q8 - total_q8;
  pwm_ = static_cast<int16_t>(possible_q8 / kOneQ8);
  watch_for_stall(encoder.counts());
  return pwm_;
}

int16_t SlideController::force_dn() const {
  if (numbers_.pwm_per_newton_q8 == 0) return 0;
  return static_cast<int16_t>(clamped(force_q8_ * 10 / numbers_.pwm_per_newton_q8, INT16_MAX));
}

}  // namespace plugpilot
