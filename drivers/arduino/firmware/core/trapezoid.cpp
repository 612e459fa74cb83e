#include "trapezoid.hpp"

namespace plugpilot {
namespace {

constexpr uint16_t kLongestPiece = 60000;  // ticks

uint32_t furthest(const int32_t (&way)[kAxes]) {
  uint32_t longest = 0;
  for (uint8_t axis = 0; axis < kAxes; ++axis) {
    const uint32_t units = static_cast<uint32_t>(way[axis] < 0 ? -way[axis] : way[axis]);
    if (units > longest) longest = units;
  }
  return longest;
}

uint32_t square_root(uint64_t value) {
  uint32_t root = 0;
  for (uint32_t bit = UINT32_C(1) << 31; bit != 0; bit >>= 1) {
    const uint32_t candidate = root | bit;
    if (static_cast<uint64_t>(candidate) * candidate <= value) root = candidate;
  }
  return root;
}

uint8_t pieces(uint32_t ticks) {
  const uint32_t count = (ticks + kLongestPiece - 1) / kLongestPiece;
  return count < UINT8_MAX ? static_cast<uint8_t>(count) : UINT8_MAX;
}

// One phase of the motion: `ticks` with an acceleration, from the rates where the queue ends.
void push_phase(Interpolator& interpolator, uint32_t ticks, const int32_t (&acceleration)[kAxes],
                bool last) {
  while (ticks > 0) {
    Segment segment = {};
    segment.ticks = static_cast<uint16_t>(ticks < kLongestPiece ? ticks : kLongestPiece);
    ticks -= segment.ticks;
    for (uint8_t axis = 0; axis < kAxes; ++axis) {
      segment.rate[axis] = interpolator.end().rate[axis];
      segment.acceleration[axis] = acceleration[axis];
    }
    interpolator.push(segment, last && ticks == 0);
  }
}

}  // namespace

// With r ticks up at acceleration a, c ticks at rate a r and r ticks down, P moves by
// a r (r + c) exactly.
bool follow(Interpolator& interpolator, const Trapezoid& motion) {
  const uint64_t way = static_cast<uint64_t>(furthest(motion.way)) * kOneUnit;
  if (way == 0) return true;
  uint32_t ramp = motion.rate / motion.acceleration + 1;
  const uint64_t ramp_and_cruise64 = way / motion.rate + 1;
  if (ramp_and_cruise64 > UINT32_MAX / 2) return false;
  uint32_t ramp_and_cruise = static_cast<uint32_t>(ramp_and_cruise64);
  if (ramp_and_cruise < ramp) ramp = ramp_and_cruise = square_root(way / motion.acceleration) + 1;
  const uint32_t cruise = ramp_and_cruise - ramp;
  if (pieces(ramp) * 2 + pieces(cruise) > interpolator.free_places()) return false;

  int32_t up[kAxes];
  int32_t down[kAxes];
  const int32_t none[kAxes] = {};
  const int64_t divisor = static_cast<int64_t>(ramp) * ramp_and_cruise;
  for (uint8_t axis = 0; axis < kAxes; ++axis) {
    up[axis] = static_cast<int32_t>(motion.way[axis] * kOneUnit / divisor);
    down[axis] = -up[axis];
  }
  // a short ramp would be over before the cruise is worked out
  interpolator.hold();
  push_phase(interpolator, ramp, up, false);
  push_phase(interpolator, cruise, none, false);
  push_phase(interpolator, ramp, down, true);
  interpolator.release();
  return true;
}

}  // namespace plugpilot
