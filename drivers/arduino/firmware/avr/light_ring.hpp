// The ring of 12 WS2812 lights: every state of the board has its colour; see README.md.
#pragma once
#include "../core/protocol.hpp"

namespace plugpilot {
namespace light_ring {

void start();

// Once a millisecond while no axis steps: shows the state, and again now and then, in case that an
// interrupt has come between two bytes and the ring has taken the pause for the end.
//
// One byte takes 10 us, during which no interrupt is served; all of it takes half a millisecond. A
// step would come late by that, so before a motion the board waits until the lights have changed.
void show(protocol::State state);

}  // namespace light_ring
}  // namespace plugpilot
