#include "light_ring.hpp"

#include <avr/interrupt.h>

#include "pins.hpp"

namespace plugpilot {
namespace light_ring {
namespace {

using protocol::State;

constexpr uint8_t kLights = 12;
constexpr uint8_t kBrightness = 24;  // of 255: next to a sleeping person it is bright enough

// In the order of the wire.
struct Colour {
  uint8_t green;
  uint8_t red;
  uint8_t blue;
  bool operator==(const Colour& other) const {
    return green == other.green && red == other.red && blue == other.blue;
  }
};

Colour colour_of(State state) {
  switch (state) {
    case State::BOOT:
      return {kBrightness / 3, kBrightness / 3, kBrightness / 3};
    case State::IDLE:
      return {0, 0, kBrightness};
    case State::FAULT:
      return {0, kBrightness, 0};
    default:
      return {kBrightness, 0, 0};
  }
}

Colour shown = {1, 1, 1};  // none of them
uint8_t lights_left = 0;

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

// An interrupt between two bits would stretch them; between two lights it may come.
void send_light(const Colour& colour) {
  const uint8_t status = SREG;
  cli();
  const uint8_t low = static_cast<uint8_t>(LIGHT_RING_PORT & ~_BV(LIGHT_RING_BIT));
  const uint8_t high = static_cast<uint8_t>(low | _BV(LIGHT_RING_BIT));
  send_byte(colour.green, high, low);
  send_byte(colour.red, high, low);
  send_byte(colour.blue, high, low);
  SREG = status;
}

}  // namespace

void start() { LIGHT_RING_DDR |= _BV(LIGHT_RING_BIT); }

void show(State state, bool moving) {
  if (moving) return;
  const Colour wanted = colour_of(state);
  if (!(wanted == shown)) {
    shown = wanted;
    lights_left = kLights;
  }
  // all in one go: a pause of 50 us would let the ring take over what it has got
  while (lights_left > 0) {
    send_light(shown);
    --lights_left;
  }
}

}  // namespace light_ring
}  // namespace plugpilot
