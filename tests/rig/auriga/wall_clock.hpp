// Keeps simulated time in step with the wall clock.
#pragma once
#include "clock.hpp"

namespace rig {

class WallClock : public Clock {
 public:
  WallClock();

  // Wait until the wall clock has come to this cycle, or return at once to make up for what is
  // missing. More than 100 ms behind, it lets go of that. No board's clock loses time like this: the
  // host then takes its samples to be older than they are, and feeds it too late.
  void wait_for(uint64_t cycle);

  // When that cycle was due: seconds of CLOCK_MONOTONIC, as in Python's time.monotonic().
  double time_s(uint64_t cycle) const override;

 private:
  double origin_s_;
};

}  // namespace rig
