// Inputs and outputs of the board, as bits of the axes.
#pragma once
#include "../core/board.hpp"

namespace plugpilot {
namespace actuators {

void start();
Inputs read();
void apply(const Outputs& outputs);

}  // namespace actuators
}  // namespace plugpilot
