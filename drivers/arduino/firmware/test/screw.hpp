// The slide's motor and screw: what the closed loop of rho3 has to master.
//
// In units of the screw's nut [mm, N]: the PWM u makes the force k (u - e v); it has to overcome dry
// friction, and a load that hinders the motion towards the car but never drives the screw, because
// that locks itself.
#pragma once
#include <algorithm>
#include <cmath>

namespace screw {

struct Numbers {
  double friction_n;
  double force_per_pwm_n;        // k
  double back_emf_pwm_s_per_mm;  // e
  double time_constant_s;        // of the unloaded speed
  double load_from_mm;           // from here on towards the car
  double load_n;
};

class Screw {
 public:
  Screw(const Numbers& numbers, double position_mm)
      : numbers_(numbers),
        mass_(numbers.force_per_pwm_n * numbers.back_emf_pwm_s_per_mm * numbers.time_constant_s),
        position_mm_(position_mm) {}

  double position_mm() const { return position_mm_; }

  void step(int pwm, double seconds) {
    const double motor_n =
        numbers_.force_per_pwm_n * (pwm - numbers_.back_emf_pwm_s_per_mm * speed_mm_s_);
    const double direction = speed_mm_s_ != 0 ? speed_mm_s_ : motor_n;
    const bool loaded = direction > 0 && position_mm_ >= numbers_.load_from_mm;
    const double against_n = numbers_.friction_n + (loaded ? numbers_.load_n : 0);
    if (speed_mm_s_ == 0) {
      const double left_n = std::max(std::fabs(motor_n) - against_n, 0.0);
      speed_mm_s_ = std::copysign(left_n, motor_n) / mass_ * seconds;
    } else {
      const double was = speed_mm_s_;
      speed_mm_s_ += (motor_n - std::copysign(against_n, was)) / mass_ * seconds;
      if (was * speed_mm_s_ < 0) speed_mm_s_ = 0;  // friction stops, it does not turn round
    }
    position_mm_ += speed_mm_s_ * seconds;
  }

 private:
  Numbers numbers_;
  double mass_;  // N per mm/s^2
  double position_mm_;
  double speed_mm_s_ = 0;
};

}  // namespace screw
