// Whether the board can follow a segment behind those it has.
#pragma once
#include "configuration.hpp"
#include "segment.hpp"

namespace plugpilot {

// The tests that concern the segment itself, in the order of the protocol's table.
//
// end: of the queue before it. moving: the set points have not come to rest there, so phases must
// match too. reached: gets the end of the queue behind it, if it is accepted.
protocol::Refusal check_segment(const protocol::Segment& segment, uint16_t next_number,
                                const QueueEnd& end, bool moving, const Configuration& config,
                                QueueEnd& reached);

// The queue may run empty with these rates: the axes stand still at once.
bool is_rest(const int32_t (&rate)[kAxes], const Configuration& config);

}  // namespace plugpilot
