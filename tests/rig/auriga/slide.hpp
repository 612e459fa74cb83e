// The slide: a DC motor behind an H-bridge, a screw, an encoder, a limit switch, and whatever load
// the plug meets.
//
// In units of the screw's nut [mm, N]: the bridge's PWM u makes the force k (u - e v); it has to
// overcome dry friction and a load that works against the motion. The screw locks itself: a load
// can hinder the motion but never drive it.
#pragma once
#include <cstdint>
#include <vector>

#include "mcu.hpp"
#include "power.hpp"
#include "switch.hpp"

namespace rig {

struct SlideNumbers {
  double start_mm;
  double lowest_mm;
  double highest_mm;
  double switch_at_mm;
  double edges_per_mm;          // all four of a period
  double force_per_pwm_n;       // k
  double back_emf_pwm_s_per_mm; // e
  double friction_n;
  double time_constant_s;       // of the unloaded speed
};

// The force against the nut over its position, for the places around it; held beyond the ends.
struct Load {
  double first_mm = 0;
  double spacing_mm = 1;
  std::vector<double> force_n = {0.0};

  double at(double position_mm) const;
};

class Slide {
 public:
  Slide(Mcu& mcu, const Power& power, const SlideNumbers& numbers);

  double position_mm() const { return position_mm_; }
  double velocity_mm_s() const { return velocity_mm_s_; }
  double load_n() const { return load_.at(position_mm_); }
  int pwm() const;
  Switch& limit_switch() { return switch_; }

  void set_load(Load load) { load_ = std::move(load); }
  void jam(bool jammed) { jammed_ = jammed; }
  void kill_encoder(bool dead) { encoder_dead_ = dead; }

 private:
  void step();
  double force_of_motor_n() const;
  void turn_encoder();

  Mcu& mcu_;
  const Power& power_;
  SlideNumbers numbers_;
  double moving_mass_;  // N per mm/s^2
  Switch switch_;
  Load load_;
  bool forwards_ = false;
  bool backwards_ = false;
  double position_mm_;
  double velocity_mm_s_ = 0;
  int64_t edge_;
  bool jammed_ = false;
  bool encoder_dead_ = false;
};

}  // namespace rig
