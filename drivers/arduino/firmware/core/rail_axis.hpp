// One stepper axis: the phase accumulator that decides at which ticks a step is due.
#pragma once
#include <stdint.h>

namespace plugpilot {

// The position is a fixed-point number P: whole steps in `position` and 2^-31 steps in `phase`,
// which stays below 2^31. Each tick P += rate, then rate += acceleration. Both are signed, so a
// change of direction within a segment is as exact as everything else.
struct RailAxis {
  uint32_t phase;
  int32_t rate;
  int32_t acceleration;
  int32_t position;
};

constexpr uint32_t kPhaseOverflow = UINT32_C(1) << 31;

// One tick; true if P has passed a whole step, in the direction of the sign that `rate` had.
//
// With |rate| < 2^31 the sum leaves [0, 2^31) by less than its width on either side. Both ways its
// highest bit is set, and clearing that bit brings the phase back into its range.
inline __attribute__((always_inline)) bool advance_by_one_tick(RailAxis& axis) {
  const uint32_t rate = static_cast<uint32_t>(axis.rate);
  const uint32_t sum = axis.phase + rate;
  axis.rate = static_cast<int32_t>(rate + static_cast<uint32_t>(axis.acceleration));
  axis.phase = sum & ~kPhaseOverflow;
  if (!(sum & kPhaseOverflow)) return false;
  axis.position += (rate & kPhaseOverflow) ? -1 : 1;
  return true;
}

}  // namespace plugpilot
