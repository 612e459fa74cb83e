// The step interrupt: 20 000 times a second it moves the rails one tick on.
#pragma once
#include <stdint.h>

namespace plugpilot {
namespace step_timer {

void start();

// Axes (bits) whose direction level is the other one.
void reverse(uint8_t axes);

// Whether a tick came late since the last call.
bool take_late_tick();

}  // namespace step_timer
}  // namespace plugpilot
