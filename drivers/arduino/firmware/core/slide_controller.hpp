// The closed loop of rho3, once a millisecond: position and speed in, PWM out, force capped.
#pragma once
#include <stdint.h>

#include "encoder.hpp"
#include "protocol.hpp"
#include "segment.hpp"

namespace plugpilot {

constexpr int16_t kPwmMax = 255;

class SlideController {
 public:
  void configure(const protocol::ConfigRho3& numbers);
  void limit_force(uint16_t force_dn);  // [0.1 N]

  // Forget what has been integrated and how long the slide has been stuck.
  void reset();

  // One millisecond.
  //
  // Args: the set point [2^-31 counts], its rate [2^-31 counts per tick], the encoder.
  // Returns the PWM, positive towards the car.
  int16_t update(int64_t set_point, int32_t rate, const Encoder& encoder);

  // Pushing at the cap for so long without a count.
  bool stalled() const { return stuck_ms_ >= numbers_.stall_ms; }

  // Whether a stall is a place where the slide was seen to push itself tight. Whatever stops it gives
  // way a little first, so its last counts come at nearly the whole force. An encoder that dies, or
  // a screw that slips, falls silent at the force of the motion before.
  bool pushed_tight() const { return tight_; }

  // The cap was in force at the last update.
  bool force_limited() const { return limited_; }

  int16_t pwm() const { return pwm_; }

  // What the PWM leaves after friction and speed voltage, positive towards the car [0.1 N].
  int16_t force_dn() const;

 private:
  int32_t wanted_q8(int32_t error_q8, int32_t speed_error_q8) const;
  bool leaves_alone(int32_t error_q8, int32_t rate, bool moved);
  void forget_other_direction(int32_t error_q8, int32_t rate);
  void integrate(int32_t error_q8, int32_t wanted_q8);
  void watch_for_stall(int32_t counts);

  protocol::ConfigRho3 numbers_ = {};
  int32_t cap_q8_ = 0;        // PWM that makes force, at most
  int32_t integral_q16_ = 0;  // PWM
  int32_t force_q8_ = 0;      // PWM that makes force
  int32_t last_counts_ = 0;
  int32_t last_rate_ = 0;
  uint16_t stuck_ms_ = 0;
  int16_t pwm_ = 0;
  bool limited_ = false;
  bool tight_ = false;    // the newest count came at nearly the whole force
  bool holding_ = false;  // it had arrived
  uint8_t stood_ms_ = 0;
};

}  // namespace plugpilot
