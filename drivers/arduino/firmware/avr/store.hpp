// What survives in the EEPROM: configuration, fault, place, number of starts.
//
// Writing a byte takes 3.3 ms, so that is done byte by byte beside everything else.
#pragma once
#include "../core/configuration.hpp"

namespace plugpilot {
namespace store {

enum class Kept : uint8_t {
  NOTHING,  // for this protocol
  DAMAGED,
  WHOLE,
};

// Only what is whole may be used.
Kept load_configuration(Configuration& configuration);
protocol::Fault load_fault();

// False if none is whole.
bool load_place(int32_t (&position)[protocol::AXES]);

// Counts the start; waits for the EEPROM.
uint16_t count_boot();

void save_configuration(const Configuration& configuration);
void save_fault(protocol::Fault fault);
void save_place(const int32_t (&position)[protocol::AXES]);

// Writes the next byte if the EEPROM is ready. Call it often.
void step();

}  // namespace store
}  // namespace plugpilot
