#include "light_ring.hpp"

#include <avr/interrupt.h>

#include "pins.hpp"

namespace plugpilot {
namespace light_ring {
namespace {

using protocol::State;

constexpr uint8_t kLights = 12;
constexpr uint8_t kBright = 24;  // of 255: next to a sleeping person it is bright enough
constexpr uint8_t kHalf = kBright / 2;
constexpr uint8_t kThird = kBright / 3;
constexpr uint16_t kRefreshMs = 500;

// In the order of the wire.
struct Colour {
  uint8_t green;
  uint8_t red;
  uint8_t blue;
};

Colour colour_of(State state) {
  switch (state) {
    case State::BOOT:
      return {kThird, kThird, kThird};  // white
    case State::IDLE:
      return {0, 0, kBright};  // blue
    case State::HOMING:
      return {0, kHalf, kHalf};  // violet
    case State::READY:
      return {kBright, 0, 0};  // green
    case State::RUN:
      return {kHalf, 0, kHalf};  // cyan
    case State::STOPPING:
      return {kThird, kBright - kThird, 0};  // amber
    default:
      return {0, kBright, 0};  // red
  }
}

State shown;
uint16_t shown_for_ms = kRefreshMs;  // nothing was ever shown

// A bit lasts 1.25 us = 20 cycles: high for 6 of them means 0, for 13 means 1. The port is outside
// the range of single-bit instructions, so both levels are prepared.
void send_byte(uint8_t byte, uint8_t high, uint8_t low) {
  uint8_t bits = 8;
  asm volatile(
      "1: st %a[port], %[high]  \n"  // 2 cycles
      "   lsl %[byte]           \n"  // 1
      "   nop                   \n"  // 1
      "   nop                   \n"  // 1
      "   brcs 2f               \n"  // 1 or 2
      "   st %a[port], %[low]   \n"  // 2: a 0 is high for 6 cycles
      "   nop                   \n"
      "   nop                   \n"
      "   nop                   \n"
      "   nop                   \n"
      "   rjmp 3f               \n"
      "2: nop                   \n"
      "   nop                   \n"
      "   nop                   \n"
      "   nop                   \n"
      "   nop                   \n"
      "   nop                   \n"
      "   st %a[port], %[low]   \n"  // a 1 is high for 13
      "3: dec %[bits]           \n"
      "   nop                   \n"
      "   nop                   \n"
      "   brne 1b               \n"
      : [byte] "+r"(byte), [bits] "+r"(bits)
      : [port] "e"(&LIGHT_RING_PORT), [high] "r"(high), [low] "r"(low));
}

// An interrupt between two bits would stretch them; between two bytes it may come.
void send_undisturbed(uint8_t byte) {
  const uint8_t status = SREG;
  cli();
  const uint8_t low = static_cast<uint8_t>(LIGHT_RING_PORT & ~_BV(LIGHT_RING_BIT));
  const uint8_t high = static_cast<uint8_t>(low | _BV(LIGHT_RING_BIT));
  send_byte(byte, high, low);
  SREG = status;
  // the processor runs one instruction between two interrupts that wait: without these the next
  // byte would come before the second of them, and that may be a tick
  asm volatile("nop \n nop \n nop \n nop \n");
}

}  // namespace

void start() { LIGHT_RING_DDR |= _BV(LIGHT_RING_BIT); }

void show(State state) {
  if (shown_for_ms < kRefreshMs) ++shown_for_ms;
  if (state == shown && shown_for_ms < kRefreshMs) return;
  shown = state;
  shown_for_ms = 0;
  const Colour colour = colour_of(state);
  for (uint8_t light = 0; light < kLights; ++light) {
    send_undisturbed(colour.green);
    send_undisturbed(colour.red);
    send_undisturbed(colour.blue);
  }
}

}  // namespace light_ring
}  // namespace plugpilot
