#include "segment_check.hpp"

namespace plugpilot {
namespace {

using protocol::Refusal;

int64_t magnitude(int64_t value) { return value < 0 ? -value : value; }

uint32_t magnitude32(int32_t value) {
  const uint32_t bits = static_cast<uint32_t>(value);
  return value < 0 ? -bits : bits;
}

int64_t outside(int32_t position, const protocol::ConfigAxis& axis) {
  if (position < axis.travel_min) return static_cast<int64_t>(axis.travel_min) - position;
  if (position > axis.travel_max) return static_cast<int64_t>(position) - axis.travel_max;
  return 0;
}

bool starts_at(const protocol::Segment& segment, const QueueEnd& end, bool moving) {
  for (uint8_t axis = 0; axis < kAxes; ++axis) {
    if (segment.start[axis] != whole_part(end.position[axis])) return false;
    if (moving && segment.phase[axis] != phase_part(end.position[axis])) return false;
  }
  return true;
}

// The sums of 64 bits are slow on the AVR, so they are worked out once, here.
bool follow_to_end(const protocol::Segment& segment, const Configuration& config,
                   QueueEnd& reached) {
  for (uint8_t axis = 0; axis < kAxes; ++axis) {
    const int64_t rate = rate_after(segment.rate[axis], segment.acceleration[axis], segment.ticks);
    // the rate is linear in time, so its ends bound it
    const uint32_t fastest = config.axis[axis].max_rate;
    if (magnitude32(segment.rate[axis]) > fastest || magnitude(rate) > fastest) return false;
    const int64_t start = centred(segment.start[axis]) - kHalfUnit + segment.phase[axis];
    reached.rate[axis] = static_cast<int32_t>(rate);
    reached.position[axis] =
        position_after(start, segment.rate[axis], segment.acceleration[axis], segment.ticks);
  }
  return true;
}

bool goes_too_far(const protocol::Segment& segment, const QueueEnd& reached,
                  const Configuration& config) {
  for (uint8_t axis = 0; axis < kAxes; ++axis) {
    const protocol::ConfigAxis& limits = config.axis[axis];
    const int32_t end = whole_part(reached.position[axis]);
    if (end >= limits.travel_min && end <= limits.travel_max) continue;
    const int64_t excess = outside(end, limits);
    if (excess > outside(segment.start[axis], limits)) return true;
  }
  return false;
}

}  // namespace

Refusal check_segment(const protocol::Segment& segment, uint16_t next_number, const QueueEnd& end,
                      bool moving, const Configuration& config, QueueEnd& reached) {
  if (segment.number != next_number) return Refusal::WRONG_NUMBER;
  if (segment.ticks == 0 || segment.ticks > protocol::MAX_SEGMENT_TICKS) return Refusal::BAD_TICKS;
  for (uint8_t axis = 0; axis < kAxes; ++axis) {
    if (segment.phase[axis] >= kOneUnit) return Refusal::BAD_VALUE;
  }
  if (!starts_at(segment, end, moving)) return Refusal::DISCONTINUOUS;
  for (uint8_t axis = 0; axis < kAxes; ++axis) {
    const int64_t jump = static_cast<int64_t>(segment.rate[axis]) - end.rate[axis];
    if (magnitude(jump) > config.axis[axis].max_rate_jump) return Refusal::RATE_JUMP;
  }
  if (!follow_to_end(segment, config, reached)) return Refusal::TOO_FAST;
  return goes_too_far(segment, reached, config) ? Refusal::BEYOND_TRAVEL : Refusal::NONE;
}

bool is_rest(const int32_t (&rate)[kAxes], const Configuration& config) {
  for (uint8_t axis = 0; axis < kAxes; ++axis) {
    if (magnitude32(rate[axis]) > config.axis[axis].max_rate_jump) return false;
  }
  return true;
}

}  // namespace plugpilot
