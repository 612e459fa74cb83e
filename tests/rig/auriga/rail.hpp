// One carriage on the rail: a stepper driver's STEP and DIR inputs, a belt, and a limit switch.
#pragma once
#include <algorithm>
#include <cstdint>
#include <functional>

#include "mcu.hpp"
#include "power.hpp"
#include "switch.hpp"

namespace rig {

// Positions are in microsteps of the true axis, not of the firmware's count.
struct RailNumbers {
  double start;
  double lowest;   // where the carriage meets its stops: the motor then slips
  double highest;
  double switch_at;  // the switch is pressed here and below
  bool reversed;
};

class Rail {
 public:
  Rail(Mcu& mcu, Pin step, Pin direction, Pin switch_pin, const Power& power,
       const RailNumbers& numbers);

  int64_t position() const { return position_; }
  Switch& limit_switch() { return switch_; }

  // Call with the position after every step that was made.
  void on_moved(std::function<void(int64_t)> action) { on_moved_ = std::move(action); }

  // --- what a stepper driver would have complained about ---

  uint64_t steps() const { return steps_; }
  uint64_t lost_steps() const { return lost_; }  // against a stop, or without power
  uint64_t shortest_pulse() const { return shortest_pulse_; }      // cycles
  uint64_t shortest_set_up() const { return shortest_set_up_; }    // direction before step, cycles
  uint64_t shortest_interval() const { return shortest_interval_; }  // between steps, cycles
  void forget_statistics();

 private:
  static constexpr uint64_t kNone = ~uint64_t{0};

  void on_step(bool high);
  void on_direction(bool high);
  void move(int way);

  Mcu& mcu_;
  const Power& power_;
  RailNumbers numbers_;
  Switch switch_;
  int64_t position_;
  std::function<void(int64_t)> on_moved_ = [](int64_t) {};
  bool backwards_ = false;
  uint64_t raised_at_ = 0;
  uint64_t direction_at_ = 0;
  uint64_t stepped_at_ = 0;
  uint64_t steps_ = 0;
  uint64_t lost_ = 0;
  uint64_t shortest_pulse_ = kNone;
  uint64_t shortest_set_up_ = kNone;
  uint64_t shortest_interval_ = kNone;
};

}  // namespace rig
