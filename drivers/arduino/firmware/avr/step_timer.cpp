#include "step_timer.hpp"

#include <avr/interrupt.h>

#include "machine.hpp"
#include "pins.hpp"

namespace plugpilot {
namespace step_timer {
namespace {

// What the last tick has worked out. Its steps are made at the beginning of the next, so that they
// come at even intervals, a whole tick after the direction was set.
uint8_t due;
volatile uint8_t reversed_pins;
volatile bool late;

// Stepper drivers want 1 to 2 us; working out a tick takes longer, unless nothing moves any more.
constexpr uint8_t kPulseCycles = 24;

}  // namespace

void start() {
  RHO1_DIR_DDR |= RHO1_DIR;
  RHO1_STEP_DDR |= RHO1_STEP;
  RHO2_DIR_DDR |= RHO2_DIR;
  RHO2_STEP_DDR |= RHO2_STEP;
  TCCR3A = 0;
  TCCR3B = _BV(WGM32) | _BV(CS30);
  OCR3A = F_CPU / protocol::TICK_HZ - 1;
  TIMSK3 = _BV(OCIE3A);
}

void reverse(uint8_t axes) { reversed_pins = static_cast<uint8_t>(axes << kBackwardsShift); }

bool take_late_tick() {
  const bool was_late = late;
  late = false;
  return was_late;
}

}  // namespace step_timer
}  // namespace plugpilot

ISR(TIMER3_COMPA_vect) {
  using namespace plugpilot;
  using namespace plugpilot::step_timer;
  const uint8_t steps = due;
  if (steps & 1) RHO1_STEP_PORT |= RHO1_STEP;
  if (steps & 2) RHO2_STEP_PORT |= RHO2_STEP;
  const uint8_t next = board.interpolator().tick(SWITCH_PIN);
  if (steps != 0 && next == 0) __builtin_avr_delay_cycles(kPulseCycles);
  RHO1_STEP_PORT &= static_cast<uint8_t>(~RHO1_STEP);
  RHO2_STEP_PORT &= static_cast<uint8_t>(~RHO2_STEP);
  if (next != 0) {
    const uint8_t directions = next ^ reversed_pins;
    if (directions & (1 << kBackwardsShift)) {
      RHO1_DIR_PORT |= RHO1_DIR;
    } else {
      RHO1_DIR_PORT &= static_cast<uint8_t>(~RHO1_DIR);
    }
    if (directions & (2 << kBackwardsShift)) {
      RHO2_DIR_PORT |= RHO2_DIR;
    } else {
      RHO2_DIR_PORT &= static_cast<uint8_t>(~RHO2_DIR);
    }
  }
  due = next & ((1 << kRails) - 1);
  if (TIFR3 & _BV(OCF3A)) late = true;
}
