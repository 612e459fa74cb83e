// Whether the board can follow a segment behind those it has.
#pragma once
#include "configuration.hpp"
#include "segment.hpp"

namespace plugpilot {

// The tests that concern the segment itself, in the order of the protocol's table.
//
// moving: the set points have not come to rest at the queue's end, so phases must match too.
protocol::Refusal check_segment(const protocol::Segment& segment, uint16_t next_number,
                                const QueueEnd& end, bool moving, const Configuration& config);

// The queue may run empty behind these end rates: the axes stand still at once.
bool ends_at_rest(const protocol::Segment& segment, const Configuration& config);

}  // namespace plugpilot
