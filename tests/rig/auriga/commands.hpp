// What can be done to the board from outside, a line each.
#pragma once
#include <string>

#include "board.hpp"
#include "wall_clock.hpp"

namespace rig {

// Do what a line says:
//
//   state | statistics                      only read
//   forget                                  begin the statistics anew
//   load FIRST_MM SPACING_MM N N ...        force against the screw over its position
//   switch AXIS cut|whole                   wire of a limit switch, AXIS 0, 1, 2
//   stop_button pressed|released
//   jam on|off                              hold the slide
//   encoder dead|alive
//   reset button|power
//   hang                                   the firmware's main loop never comes round again
//   link cut|whole|unplugged|plugged        wires, or the whole device
//   faults LOSE FLIP DUPLICATE DELAY_S      chances per byte, both ways
//
// Returns the answer as JSON: the statistics, or the state as it was when the line had been obeyed.
// Throws std::invalid_argument for anything else.
std::string obey(const std::string& line, Board& board, WallClock& clock);

}  // namespace rig
