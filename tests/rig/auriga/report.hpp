// What the control channel tells about the board, as JSON.
#pragma once
#include <string>

#include "board.hpp"
#include "wall_clock.hpp"

namespace rig {

// Where everything truly is, and when.
std::string state_json(Board& board, const WallClock& clock);

// What the steppers, the tick, the line and the simulator have been like.
std::string statistics_json(const Board& board, const WallClock& clock);

}  // namespace rig
