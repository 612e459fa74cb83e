#include "actuators.hpp"

#include <avr/interrupt.h>

#include "machine.hpp"
#include "pins.hpp"
#include "step_timer.hpp"

namespace plugpilot {
namespace actuators {
namespace {

volatile int32_t encoder_counts;

constexpr uint8_t kSwitchPins[kAxes] = {RHO1_SWITCH, RHO2_SWITCH, RHO3_SWITCH};

uint8_t axes_of(uint8_t pins) {
  uint8_t axes = 0;
  for (uint8_t axis = 0; axis < kAxes; ++axis) {
    if (pins & kSwitchPins[axis]) axes |= static_cast<uint8_t>(1 << axis);
  }
  return axes;
}

uint8_t pins_of(uint8_t axes) {
  uint8_t pins = 0;
  for (uint8_t axis = 0; axis < kAxes; ++axis) {
    if (axes & (1 << axis)) pins |= kSwitchPins[axis];
  }
  return pins;
}

void drive_motor(int16_t pwm) {
  MOTOR_BRIDGE_PORT &= static_cast<uint8_t>(~(MOTOR_FORWARDS | MOTOR_BACKWARDS));
  OCR1A = static_cast<uint8_t>(pwm < 0 ? -pwm : pwm);
  if (pwm > 0) MOTOR_BRIDGE_PORT |= MOTOR_FORWARDS;
  if (pwm < 0) MOTOR_BRIDGE_PORT |= MOTOR_BACKWARDS;
}

}  // namespace

void start() {
  SWITCH_PULL_UP = RHO1_SWITCH | RHO2_SWITCH | RHO3_SWITCH | STOP_CIRCUIT;
  DRIVE_RELAY_DDR |= DRIVE_RELAY;
  ENCODER_A_PULL_UP |= ENCODER_A;
  ENCODER_B_PULL_UP |= ENCODER_B;
  EICRA = _BV(ISC20);  // both edges of A: two counts per period
  EIMSK = _BV(INT2);
  MOTOR_BRIDGE_DDR |= MOTOR_FORWARDS | MOTOR_BACKWARDS;
  MOTOR_PWM_DDR |= MOTOR_PWM;
  TCCR1A = _BV(COM1A1) | _BV(WGM10);  // 8 bits at 7.8 kHz
  TCCR1B = _BV(WGM12) | _BV(CS11);
}

Inputs read() {
  Inputs inputs = {};
  const uint8_t levels = SWITCH_PIN;
  inputs.switch_levels = axes_of(levels);
  inputs.stop_circuit_open = levels & STOP_CIRCUIT;
  CriticalSection lock;
  inputs.tripped = axes_of(board.interpolator().switches().take_tripped());
  inputs.encoder_raw = encoder_counts;
  return inputs;
}

void apply(const Outputs& outputs) {
  // no interrupt writes to the ports K and L
  if (outputs.drives_on) {
    DRIVE_RELAY_PORT |= DRIVE_RELAY;
  } else {
    DRIVE_RELAY_PORT &= static_cast<uint8_t>(~DRIVE_RELAY);
  }
  drive_motor(outputs.pwm);
  step_timer::reverse(outputs.reversed);
  board.interpolator().switches().watch(pins_of(outputs.watched),
                                        pins_of(outputs.released_levels));
}

}  // namespace actuators
}  // namespace plugpilot

ISR(INT2_vect) {
  using namespace plugpilot::actuators;
  const bool a = ENCODER_A_PIN & ENCODER_A;
  const bool b = ENCODER_B_PIN & ENCODER_B;
  encoder_counts = encoder_counts + (a == b ? -1 : 1);
}
