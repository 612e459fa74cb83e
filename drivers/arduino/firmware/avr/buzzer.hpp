// The buzzer: three tones when a fault is latched.
#pragma once
#include "../core/protocol.hpp"

namespace plugpilot {
namespace buzzer {

void start();

// Once a millisecond.
void every_millisecond(protocol::Fault fault);

}  // namespace buzzer
}  // namespace plugpilot
