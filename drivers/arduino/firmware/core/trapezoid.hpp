// Motions that the board plans by itself: from rest to rest along a straight line of joint space.
#pragma once
#include "interpolator.hpp"

namespace plugpilot {

struct Trapezoid {
  int32_t way[kAxes];     // [units], signed
  uint32_t rate;          // of the axis that goes furthest, not reached on a short way
  uint32_t acceleration;  // of the same axis
};

// Puts the motion into an interpolator that is at rest. Nothing happens without a way. False if it
// does not fit into the queue: such slow numbers make no sense.
bool follow(Interpolator& interpolator, const Trapezoid& motion);

}  // namespace plugpilot
