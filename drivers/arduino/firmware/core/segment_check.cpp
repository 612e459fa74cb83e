#include "segment_check.hpp"

namespace plugpilot {
namespace {

using protocol::Refusal;

int64_t magnitude(int64_t value) { return value < 0 ? -value : value; }

int64_t end_rate(const protocol::Segment& segment, uint8_t axis) {
  return rate_after(segment.rate[axis], segment.acceleration[axis], segment.ticks);
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

bool goes_too_far(const protocol::Segment& segment, const Configuration& config) {
  for (uint8_t axis = 0; axis < kAxes; ++axis) {
    const int64_t start = segment.start[axis] * kOneUnit + segment.phase[axis];
    const int32_t reached = whole_part(position_after(start, segment.rate[axis],
                                                      segment.acceleration[axis], segment.ticks));
    const int64_t excess = outside(reached, config.axis[axis]);
    if (excess > 0 && excess > outside(segment.start[axis], config.axis[axis])) return true;
  }
  return false;
}

}  // namespace

Refusal check_segment(const protocol::Segment& segment, uint16_t next_number, const QueueEnd& end,
                      bool moving, const Configuration& config) {
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
  for (uint8_t axis = 0; axis < kAxes; ++axis) {
    // the rate is linear in time, so its ends bound it
    const uint32_t fastest = config.axis[axis].max_rate;
    if (magnitude(segment.rate[axis]) > fastest || magnitude(end_rate(segment, axis)) > fastest) {
      return Refusal::TOO_FAST;
    }
  }
  return goes_too_far(segment, config) ? Refusal::BEYOND_TRAVEL : Refusal::NONE;
}

bool ends_at_rest(const protocol::Segment& segment, const Configuration& config) {
  for (uint8_t axis = 0; axis < kAxes; ++axis) {
    if (magnitude(end_rate(segment, axis)) > config.axis[axis].max_rate_jump) return false;
  }
  return true;
}

}  // namespace plugpilot
