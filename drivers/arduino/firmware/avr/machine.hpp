// The one board and its link.
#pragma once
#include "../core/board.hpp"
#include "../core/link.hpp"

namespace plugpilot {

extern Board board;
extern Link link;

}  // namespace plugpilot
