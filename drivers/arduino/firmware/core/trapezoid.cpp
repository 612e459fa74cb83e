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

// From the highest bit that the root can have: trying a bit multiplies, which is slow here.
uint32_t square_root(uint64_t value) {
  uint32_t bit = 1;
  for (uint64_t rest = value; rest > 3; rest >>= 2) bit <<= 1;
  uint32_t root = 0;
  for (; bit != 0; bit >>= 1) {
    const uint32_t candidate = root | bit;
    if (static_cast<uint64_t>(candidate) * candidate <= value) root = candidate;
  }
  return root;
}

uint8_t pieces(uint32_t ticks) {
  const uint32_t count = (ticks + kLongestPiece - 1) / kLongestPiece;
  return count < UINT8_MAX ? static_cast<uint8_t>(count) : UINT8_MAX;
}

}  // namespace

// With r ticks up at acceleration a, c ticks at rate a r and r ticks down, P moves by
// a r (r + c) exactly.
bool TrapezoidPlan::begin(const Trapezoid& motion, uint8_t free_places) {
  phase_ = kPhases;
  const uint64_t way = static_cast<uint64_t>(furthest(motion.way)) * kOneUnit;
  if (way == 0) return true;
  uint32_t ramp = motion.rate / motion.acceleration + 1;
  const uint64_t ramp_and_cruise64 = way / motion.rate + 1;
  if (ramp_and_cruise64 > UINT32_MAX / 2) return false;
  uint32_t ramp_and_cruise = static_cast<uint32_t>(ramp_and_cruise64);
  if (ramp_and_cruise < ramp) ramp = ramp_and_cruise = square_root(way / motion.acceleration) + 1;
  const uint32_t cruise = ramp_and_cruise - ramp;
  if (pieces(ramp) * 2 + pieces(cruise) > free_places) return false;

  const int64_t divisor = static_cast<int64_t>(ramp) * ramp_and_cruise;
  for (uint8_t axis = 0; axis < kAxes; ++axis) {
    acceleration_[axis] =
        motion.way[axis] == 0 ? 0 : static_cast<int32_t>(motion.way[axis] * kOneUnit / divisor);
  }
  ticks_[UP] = ticks_[DOWN] = ramp;
  ticks_[CRUISE] = cruise;
  phase_ = UP;
  return true;
}

void TrapezoidPlan::push_next(Interpolator& interpolator) {
  // a short ramp would be over before the cruise is there
  interpolator.hold();
  uint32_t& left = ticks_[phase_];
  Segment segment = {};
  segment.ticks = static_cast<uint16_t>(left < kLongestPiece ? left : kLongestPiece);
  QueueEnd reached = interpolator.end();
  for (uint8_t axis = 0; axis < kAxes; ++axis) {
    segment.rate[axis] = reached.rate[axis];
    segment.acceleration[axis] = phase_ == UP     ? acceleration_[axis]
                                 : phase_ == DOWN ? -acceleration_[axis]
                                                  : 0;
  }
  reached.append(segment);
  left -= segment.ticks;
  skip_empty_phases();
  interpolator.push(segment, reached, !pending());
  if (!pending()) interpolator.release();
}

void TrapezoidPlan::skip_empty_phases() {
  while (phase_ < kPhases && ticks_[phase_] == 0) ++phase_;
}

}  // namespace plugpilot
