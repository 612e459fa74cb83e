// Motions that the board plans by itself: from rest to rest along a straight line of joint space.
#pragma once
#include "interpolator.hpp"

namespace plugpilot {

struct Trapezoid {
  int32_t way[kAxes];     // [units], signed
  uint32_t rate;          // of the axis that goes furthest, not reached on a short way
  uint32_t acceleration;  // of the same axis
};

// Puts a motion into an interpolator that is at rest.
//
// All at once would hold up the closed loop of rho3 for two milliseconds, so the motion is handed
// over segment by segment and begins when the last one is there.
class TrapezoidPlan {
 public:
  // Works the motion out; there is nothing to push if it has no way. False if it does not fit into
  // so many places of the queue: such slow numbers make no sense.
  bool begin(const Trapezoid& motion, uint8_t free_places);

  // Segments are left to be pushed.
  bool pending() const { return phase_ < kPhases; }

  void push_next(Interpolator& interpolator);

 private:
  enum Phase : uint8_t { UP, CRUISE, DOWN, kPhases };

  void skip_empty_phases();

  int32_t acceleration_[kAxes] = {};  // of the first phase, and reversed of the last
  uint32_t ticks_[kPhases] = {};      // left in each phase
  uint8_t phase_ = kPhases;
};

}  // namespace plugpilot
