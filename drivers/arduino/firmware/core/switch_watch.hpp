// Limit switches as the step interrupt sees them: whole port levels, compared in one go.
#pragma once
#include <stdint.h>

namespace plugpilot {

// Masks are in the bits of the port that the switches are wired to.
class SwitchWatch {
 public:
  // The step interrupt: true if a watched switch is pressed, or its wire cut.
  inline __attribute__((always_inline)) bool trips(uint8_t levels) {
    const uint8_t pressed = static_cast<uint8_t>((levels ^ released_levels_) & watched_);
    if (pressed == 0) return false;
    tripped_ = tripped_ | pressed;
    return true;
  }

  bool has_tripped() const { return tripped_ != 0; }

  void watch(uint8_t mask, uint8_t released_levels) {
    released_levels_ = released_levels;
    watched_ = mask;
  }

  // Which switches have tripped since the last call.
  uint8_t take_tripped() {
    const uint8_t tripped = tripped_;
    tripped_ = 0;
    return tripped;
  }

 private:
  volatile uint8_t watched_ = 0;
  volatile uint8_t released_levels_ = 0;
  volatile uint8_t tripped_ = 0;
};

}  // namespace plugpilot
