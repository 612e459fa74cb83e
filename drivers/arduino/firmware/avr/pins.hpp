// Where everything is plugged in: the one place. README.md shows the same as a wiring table.
#pragma once
#include <avr/io.h>

#define PIN_MASK(bit) static_cast<uint8_t>(1U << (bit))

// RJ25 port 1: stepper module of rho1
#define RHO1_DIR_PORT PORTE  // D5
#define RHO1_DIR_DDR DDRE
#define RHO1_DIR PIN_MASK(PE3)
#define RHO1_STEP_PORT PORTG  // D4
#define RHO1_STEP_DDR DDRG
#define RHO1_STEP PIN_MASK(PG5)

// RJ25 port 2: stepper module of rho2
#define RHO2_DIR_PORT PORTE  // D3
#define RHO2_DIR_DDR DDRE
#define RHO2_DIR PIN_MASK(PE5)
#define RHO2_STEP_PORT PORTE  // D2
#define RHO2_STEP_DDR DDRE
#define RHO2_STEP PIN_MASK(PE4)

// RJ25 ports 6, 7, 8: all inputs are on port K and normally closed to ground
#define SWITCH_PIN PINK
#define SWITCH_PULL_UP PORTK
#define RHO1_SWITCH PIN_MASK(PK2)   // A10, port 6 slot 1
#define RHO2_SWITCH PIN_MASK(PK7)   // A15, port 6 slot 2
#define RHO3_SWITCH PIN_MASK(PK1)   // A9, port 7 slot 1
#define STOP_CIRCUIT PIN_MASK(PK0)  // A8, port 8 slot 1

#define DRIVE_RELAY_PORT PORTK  // A13, port 8 slot 2: high lets the drives have power
#define DRIVE_RELAY_DDR DDRK
#define DRIVE_RELAY PIN_MASK(PK5)

// Encoder motor slot 1: the slide, rho3
#define ENCODER_A_PIN PIND  // D19, INT2
#define ENCODER_A_PULL_UP PORTD
#define ENCODER_A PIN_MASK(PD2)
#define ENCODER_B_PIN PINL  // D42
#define ENCODER_B_PULL_UP PORTL
#define ENCODER_B PIN_MASK(PL7)
#define MOTOR_PWM_DDR DDRB  // D11, OC1A
#define MOTOR_PWM PIN_MASK(PB5)
#define MOTOR_BRIDGE_PORT PORTL
#define MOTOR_BRIDGE_DDR DDRL
#define MOTOR_BACKWARDS PIN_MASK(PL0)  // D49, H1
#define MOTOR_FORWARDS PIN_MASK(PL1)   // D48, H2: towards the car

// On the board
#define THERMISTOR_CHANNEL 0  // A0
#define SUPPLY_CHANNEL 4      // A4: a third of it
#define LIGHT_RING_PORT PORTL  // D44, 12 WS2812
#define LIGHT_RING_DDR DDRL
#define LIGHT_RING_BIT PL5
#define BUZZER_PORT PORTL  // D45
#define BUZZER_DDR DDRL
#define BUZZER PIN_MASK(PL4)
