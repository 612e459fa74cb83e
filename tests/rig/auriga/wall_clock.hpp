// Keeps simulated time in step with the wall clock.
#pragma once
#include <cstdint>

namespace rig {

class WallClock {
 public:
  // Args: simulated seconds per second.
  explicit WallClock(double speed);

  // Wait until the wall clock has come to this cycle. More than 20 ms behind, it lets go of what is
  // missing: nobody is helped by a burst afterwards.
  void wait_for(uint64_t cycle);

  // When that cycle was due: seconds of CLOCK_MONOTONIC, as in Python's time.monotonic().
  double due_s(uint64_t cycle) const;

  double worst_lag_s() const { return worst_lag_s_; }
  double slept_s() const { return slept_s_; }
  double elapsed_s() const;
  void forget_statistics();

 private:
  double speed_;
  double origin_s_;
  double began_s_;
  double worst_lag_s_ = 0;
  double slept_s_ = 0;
};

}  // namespace rig
