#include "buzzer.hpp"

#include "pins.hpp"

namespace plugpilot {
namespace buzzer {
namespace {

constexpr uint16_t kAlarmMs = 900;  // three tones and three pauses
constexpr uint16_t kToneMs = 150;

protocol::Fault told = protocol::Fault::NONE;
uint16_t left_ms = 0;

// No interrupt writes this port.
void set(bool high) {
  if (high) {
    BUZZER_PORT |= BUZZER;
  } else {
    BUZZER_PORT &= static_cast<uint8_t>(~BUZZER);
  }
}

}  // namespace

void start() { BUZZER_DDR |= BUZZER; }

void every_millisecond(protocol::Fault fault) {
  if (fault != told) {
    told = fault;
    left_ms = fault == protocol::Fault::NONE ? 0 : kAlarmMs;
    set(false);
  }
  if (left_ms == 0) return;
  --left_ms;
  const bool tone = left_ms / kToneMs % 2 == 1;
  set(tone && left_ms % 2 == 1);  // one level per millisecond: 500 Hz
}

}  // namespace buzzer
}  // namespace plugpilot
