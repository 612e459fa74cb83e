// One pin of the microcontroller, made from the names of the firmware's list.
#pragma once
#include <avr/pins.hpp>

namespace rig {

struct Pin {
  char port;
  int bit;

  // Args: a port as the list names it, and the pin's mask in it.
  constexpr Pin(PortLetter letter, uint8_t mask)
      : port(letter), bit(__builtin_ctz(mask)) {}
  constexpr Pin(char port, int bit) : port(port), bit(bit) {}
};

}  // namespace rig
