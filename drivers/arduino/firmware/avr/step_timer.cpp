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
volatile uint8_t reversed_axes;
volatile uint8_t shown_directions;  // so that the pins are touched only when one turns round
volatile bool late;

// Stepper drivers want 1 to 2 us; working out a tick takes longer, unless nothing moves any more.
constexpr uint8_t kPulseCycles = 24;

// Timer 2, because of two interrupts that wait the one with the lower number comes first: only the
// encoders are before it, and the serial port is behind.
constexpr uint8_t kPrescaler = 8;

constexpr uint8_t kStepBits = (1 << kRails) - 1;
constexpr uint8_t kDirectionBits = kStepBits << kBackwardsShift;
constexpr uint8_t kNotShown = 0xFF;

inline __attribute__((always_inline)) void show_directions(uint8_t backwards) {
  shown_directions = backwards;
  const uint8_t levels = backwards ^ reversed_axes;
  if (levels & (1 << kBackwardsShift)) {
    RHO1_DIR_PORT |= RHO1_DIR;
  } else {
    RHO1_DIR_PORT &= static_cast<uint8_t>(~RHO1_DIR);
  }
  if (levels & (2 << kBackwardsShift)) {
    RHO2_DIR_PORT |= RHO2_DIR;
  } else {
    RHO2_DIR_PORT &= static_cast<uint8_t>(~RHO2_DIR);
  }
}

// Calls end_segment_at_the_end_of_a_tick() without the compiler knowing of it: see Interpolator.
struct EndSegment {
  inline __attribute__((always_inline)) void operator()(Interpolator&) const {
    asm volatile("call end_segment_saving_registers" ::: "memory");
  }
};

}  // namespace

void start() {
  RHO1_DIR_DDR |= RHO1_DIR;
  RHO1_STEP_DDR |= RHO1_STEP;
  RHO2_DIR_DDR |= RHO2_DIR;
  RHO2_STEP_DDR |= RHO2_STEP;
  TCCR2A = _BV(WGM21);
  TCCR2B = _BV(CS21);
  OCR2A = F_CPU / kPrescaler / protocol::TICK_HZ - 1;
  TIMSK2 = _BV(OCIE2A);
}

void reverse(uint8_t axes) {
  const uint8_t reversed = static_cast<uint8_t>(axes << kBackwardsShift) & kDirectionBits;
  if (reversed == reversed_axes) return;
  reversed_axes = reversed;
  shown_directions = kNotShown;
}

bool take_late_tick() {
  const bool was_late = late;
  late = false;
  return was_late;
}

}  // namespace step_timer
}  // namespace plugpilot

extern "C" {

void end_segment_at_the_end_of_a_tick() __attribute__((used));
void end_segment_at_the_end_of_a_tick() { plugpilot::board.interpolator().end_segment(); }

// Saves what a function may change by the calling convention.
void end_segment_saving_registers() __attribute__((naked, used));
void end_segment_saving_registers() {
  asm volatile(
      "push r0  \n push r18 \n push r19 \n push r20 \n push r21 \n push r22 \n push r23 \n"
      "push r24 \n push r25 \n push r26 \n push r27 \n push r30 \n push r31 \n"
      "call end_segment_at_the_end_of_a_tick \n"
      "pop r31  \n pop r30  \n pop r27  \n pop r26  \n pop r25  \n pop r24  \n"
      "pop r23  \n pop r22  \n pop r21  \n pop r20  \n pop r19  \n pop r18  \n pop r0 \n"
      "ret      \n");
}
}

ISR(TIMER2_COMPA_vect) {
  using namespace plugpilot;
  using namespace plugpilot::step_timer;
  const uint8_t steps = due;
  if (steps & 1) RHO1_STEP_PORT |= RHO1_STEP;
  if (steps & 2) RHO2_STEP_PORT |= RHO2_STEP;
  const uint8_t next = board.interpolator().tick(SWITCH_PIN, EndSegment());
  if (steps != 0 && next == 0) __builtin_avr_delay_cycles(kPulseCycles);
  RHO1_STEP_PORT &= static_cast<uint8_t>(~RHO1_STEP);
  RHO2_STEP_PORT &= static_cast<uint8_t>(~RHO2_STEP);
  due = next & kStepBits;
  const uint8_t backwards = next & kDirectionBits;
  if (due != 0 && backwards != shown_directions) show_directions(backwards);
  if (TIFR2 & _BV(OCF2A)) late = true;
}
