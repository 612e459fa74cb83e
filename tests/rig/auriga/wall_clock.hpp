// Keeps simulated time in step with the wall clock.
#pragma once
#include "clock.hpp"

namespace rig {

class WallClock : public Clock {
 public:
  WallClock();

  // Wait until the wall clock has come to this cycle. More than 20 ms behind, it lets go of what is
  // missing: nobody is helped by a burst afterwards.
  void wait_for(uint64_t cycle);

  // When that cycle was due: seconds of CLOCK_MONOTONIC, as in Python's time.monotonic().
  double time_s(uint64_t cycle) const override;

 private:
  double origin_s_;
};

}  // namespace rig
