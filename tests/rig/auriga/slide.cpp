#include "slide.hpp"

#include <algorithm>
#include <cmath>

namespace rig {
namespace {

constexpr uint64_t kStepCycles = 800;  // 50 us: at full speed the encoder makes an edge in 200
constexpr double kStepS = static_cast<double>(kStepCycles) / kCpuHz;

// Registers of timer 1: simavr has no output to watch for the bridge's PWM.
constexpr uint16_t kTccr1a = 0x80;
constexpr uint16_t kOcr1al = 0x88;
constexpr uint8_t kCom1a1 = 0x80;

constexpr Pin kPhaseA(PORTD, ENCODER_A);
constexpr Pin kPhaseB(PORTL, ENCODER_B);

}  // namespace

double Load::at(double position_mm) const {
  const double place = (position_mm - first_mm) / spacing_mm;
  if (place <= 0) return force_n.front();
  if (place >= force_n.size() - 1) return force_n.back();
  const auto below = static_cast<size_t>(place);
  const double share = place - below;
  return force_n[below] * (1 - share) + force_n[below + 1] * share;
}

Slide::Slide(Mcu& mcu, const Power& power, const SlideNumbers& numbers)
    : mcu_(mcu),
      power_(power),
      numbers_(numbers),
      moving_mass_(numbers.force_per_pwm_n * numbers.back_emf_pwm_s_per_mm *
                   numbers.time_constant_s),
      switch_(mcu, Pin(SWITCH_PIN, RHO3_SWITCH)),
      position_mm_(numbers.start_mm),
      edge_(std::llround(numbers.start_mm * numbers.edges_per_mm)) {
  mcu.watch(Pin(MOTOR_BRIDGE_PORT, MOTOR_FORWARDS), [this](bool high) { forwards_ = high; });
  mcu.watch(Pin(MOTOR_BRIDGE_PORT, MOTOR_BACKWARDS), [this](bool high) { backwards_ = high; });
  mcu.every(kStepCycles, [this] { step(); });
  turn_encoder();
}

int Slide::pwm() const {
  if (!(mcu_.data(kTccr1a) & kCom1a1) || forwards_ == backwards_) return 0;
  const int duty = mcu_.data(kOcr1al);
  return forwards_ ? duty : -duty;
}

double Slide::force_of_motor_n() const {
  // without power the bridge is open; without a direction it shorts the motor, which brakes
  if (!power_.on()) return 0;
  return numbers_.force_per_pwm_n * (pwm() - numbers_.back_emf_pwm_s_per_mm * velocity_mm_s_);
}

void Slide::step() {
  const double motor_n = force_of_motor_n();
  const double direction = velocity_mm_s_ != 0 ? velocity_mm_s_ : motor_n;
  const double against_n =
      numbers_.friction_n + std::max(std::copysign(1.0, direction) * load_n(), 0.0);
  if (velocity_mm_s_ == 0) {
    const double left_n = std::abs(motor_n) - against_n;
    if (left_n > 0) velocity_mm_s_ = std::copysign(left_n, motor_n) / moving_mass_ * kStepS;
  } else {
    const double was = velocity_mm_s_;
    velocity_mm_s_ += (motor_n - std::copysign(against_n, was)) / moving_mass_ * kStepS;
    if (was * velocity_mm_s_ < 0) velocity_mm_s_ = 0;  // friction stops, it does not turn around
  }
  if (jammed_) velocity_mm_s_ = 0;
  if (velocity_mm_s_ == 0) return;
  position_mm_ += velocity_mm_s_ * kStepS;
  if (position_mm_ < numbers_.lowest_mm || position_mm_ > numbers_.highest_mm) {
    position_mm_ = std::clamp(position_mm_, numbers_.lowest_mm, numbers_.highest_mm);
    velocity_mm_s_ = 0;
  }
  turn_encoder();
}

void Slide::turn_encoder() {
  switch_.press(position_mm_ <= numbers_.switch_at_mm);
  const auto edge = static_cast<int64_t>(std::floor(position_mm_ * numbers_.edges_per_mm));
  if (edge > edge_) ++edge_;
  if (edge < edge_) --edge_;
  if (encoder_dead_) return;
  // forwards A leads: 00, 10, 11, 01
  const int quarter = static_cast<int>(edge_ & 3);
  mcu_.drive(kPhaseA, quarter == 1 || quarter == 2);
  mcu_.drive(kPhaseB, quarter == 2 || quarter == 3);
}

}  // namespace rig
