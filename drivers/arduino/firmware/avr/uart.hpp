// UART0 with a ring buffer each way.
#pragma once
#include "../core/ring_buffer.hpp"

namespace plugpilot {
namespace uart {

extern ReceiveBuffer received;
extern SendBuffer to_send;

void start();

// Begin to send what is in the buffer.
void kick();

// Whether bytes were lost since the last call.
bool take_overrun();

}  // namespace uart
}  // namespace plugpilot
