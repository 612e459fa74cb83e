// Supply voltage and temperature of the board: slow, so never waited for.
#pragma once
#include "../core/board.hpp"

namespace plugpilot {
namespace gauges {

void start();

// Once a millisecond: takes what the converter has ready and lets it measure the other one.
void every_millisecond();

// Fills in the newest values.
void read(Inputs& inputs);

}  // namespace gauges
}  // namespace plugpilot
