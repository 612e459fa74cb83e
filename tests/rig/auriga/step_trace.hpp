// Every single step of the carriages: when, in which tick, and where it led.
#pragma once
#include <cstdint>
#include <vector>

#include "mcu.hpp"
#include "rail.hpp"
#include "tick_watch.hpp"

namespace rig {

struct Step {
  uint64_t cycle;
  uint64_t tick;  // step interrupts begun since the reset, this one included
  int64_t position;
};

class StepTrace {
 public:
  StepTrace(const Mcu& mcu, const TickWatch& ticks, Rail& rho1, Rail& rho2);

  // Begin anew, or end.
  void record(bool on);
  const std::vector<Step>& steps(int axis) const { return steps_[axis]; }

 private:
  bool on_ = false;
  std::vector<Step> steps_[2];
};

}  // namespace rig
