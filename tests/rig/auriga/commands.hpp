// What can be done to the board from outside, a line each.
#pragma once
#include <string>

#include "board.hpp"
#include "clock.hpp"

namespace rig {

// Do what a line says:
//
//   state | statistics | steps              only read
//   forget                                  begin the statistics anew
//   load FIRST_MM SPACING_MM N N ...        force against the screw over its position
//   record on|off                           every step, from now on; read them with steps
//   switch AXIS whole|cut|stuck             a limit switch, AXIS 0, 1, 2; stuck closed
//   stop_button pressed|released
//   jam on|off                              hold the slide
//   encoder dead|alive
//   reset button|power
//   hang                                   the firmware's main loop never comes round again
//   link cut|whole|unplugged|plugged        wires, or the whole device
//   faults LOSE FLIP DUPLICATE DELAY_S      chances per byte, both ways
//   eeprom ADDRESS MASK                     flip bits of a byte
//
// Returns the answer as JSON: what was asked for, or the state when the line had been obeyed.
// Throws std::invalid_argument for anything else.
std::string obey(const std::string& line, Board& board, const Clock& clock);

}  // namespace rig
