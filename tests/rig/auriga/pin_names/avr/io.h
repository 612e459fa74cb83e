// Stands in for avr-libc's header where the simulator reads the firmware's list of pins: a port is
// its letter, a pin its number.
#pragma once
#include <stdint.h>

// clang-format off
enum PortLetter : char {
  PORTA = 'A', PORTB, PORTC, PORTD, PORTE, PORTF, PORTG, PORTH, PORTJ = 'J', PORTK, PORTL,
  DDRA = 'A', DDRB, DDRC, DDRD, DDRE, DDRF, DDRG, DDRH, DDRJ = 'J', DDRK, DDRL,
  PINA = 'A', PINB, PINC, PIND, PINE, PINF, PING, PINH, PINJ = 'J', PINK, PINL,
};
enum PinNumber : uint8_t {
  PA0, PA1, PA2, PA3, PA4, PA5, PA6, PA7,
  PB0 = 0, PB1, PB2, PB3, PB4, PB5, PB6, PB7,
  PC0 = 0, PC1, PC2, PC3, PC4, PC5, PC6, PC7,
  PD0 = 0, PD1, PD2, PD3, PD4, PD5, PD6, PD7,
  PE0 = 0, PE1, PE2, PE3, PE4, PE5, PE6, PE7,
  PF0 = 0, PF1, PF2, PF3, PF4, PF5, PF6, PF7,
  PG0 = 0, PG1, PG2, PG3, PG4, PG5,
  PH0 = 0, PH1, PH2, PH3, PH4, PH5, PH6, PH7,
  PJ0 = 0, PJ1, PJ2, PJ3, PJ4, PJ5, PJ6, PJ7,
  PK0 = 0, PK1, PK2, PK3, PK4, PK5, PK6, PK7,
  PL0 = 0, PL1, PL2, PL3, PL4, PL5, PL6, PL7,
};
// clang-format on
