#include "uart.hpp"

#include <avr/interrupt.h>
#include <avr/io.h>

#include "../core/protocol.hpp"

namespace plugpilot {
namespace uart {

ReceiveBuffer received;
SendBuffer to_send;

namespace {

volatile bool overrun;

// Double speed: 8 clocks per sample, and 500 000 baud come out exactly.
constexpr uint32_t kDivisor = 8 * protocol::BAUD;

}  // namespace

void start() {
  UCSR0A = _BV(U2X0);
  UBRR0 = static_cast<uint16_t>((F_CPU + kDivisor / 2) / kDivisor - 1);
  UCSR0C = _BV(UCSZ01) | _BV(UCSZ00);
  UCSR0B = _BV(RXEN0) | _BV(TXEN0) | _BV(RXCIE0);
}

void kick() {
  if (!to_send.empty()) UCSR0B |= _BV(UDRIE0);
}

bool take_overrun() {
  const bool lost = overrun;
  overrun = false;
  return lost;
}

}  // namespace uart
}  // namespace plugpilot

ISR(USART0_RX_vect) {
  using namespace plugpilot::uart;
  const uint8_t status = UCSR0A;
  const uint8_t byte = UDR0;
  if ((status & _BV(DOR0)) || !received.put(byte)) overrun = true;
}

ISR(USART0_UDRE_vect) {
  using namespace plugpilot::uart;
  if (to_send.empty()) {
    UCSR0B &= static_cast<uint8_t>(~_BV(UDRIE0));
  } else {
    UDR0 = to_send.take();
  }
}
