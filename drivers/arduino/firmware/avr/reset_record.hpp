// Why the board started, and what was wrong before.
#pragma once
#include "../core/protocol.hpp"

namespace plugpilot {
namespace reset_record {

protocol::ResetCause cause();

// The fault that was latched when the board went down; it survives a reset, but no power cut.
protocol::Fault fault_before();

// The fault that is latched now.
void keep(protocol::Fault fault);

}  // namespace reset_record
}  // namespace plugpilot
