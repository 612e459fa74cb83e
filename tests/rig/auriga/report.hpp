// What the control channel tells about the board, as JSON.
#pragma once
#include <string>

#include "board.hpp"
#include "clock.hpp"

namespace rig {

// Where everything truly is, and when.
std::string state_json(Board& board, const Clock& clock);

// What the steppers, the tick and the line have been like.
std::string statistics_json(const Board& board);

// The recorded steps of both carriages, as [cycle, tick, position].
std::string steps_json(const StepTrace& trace);

// What was wrong with a command.
std::string error_json(const std::string& words);

}  // namespace rig
