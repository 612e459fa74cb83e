// The ring of 12 WS2812 lights: blue with the drives off, green with them on, red with a fault,
// white without a configuration.
#pragma once
#include "../core/protocol.hpp"

namespace plugpilot {
namespace light_ring {

void start();

// Shows the state. One light takes 30 us, during which no interrupt is served: a tick would come
// late, so nothing is sent while anything moves, and no colour tells moving from resting. At rest
// a late tick moves nothing, and none is lost.
void show(protocol::State state, bool moving);

}  // namespace light_ring
}  // namespace plugpilot
