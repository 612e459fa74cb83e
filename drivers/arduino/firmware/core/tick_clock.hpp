// Board time in ticks, counted by the step interrupt.
#pragma once
#include <stdint.h>

#include "protocol.hpp"

namespace plugpilot {

constexpr uint8_t kTicksPerMillisecond = protocol::TICK_HZ / 1000;

// Counting milliseconds and the ticks since the last one is cheaper than a 32-bit sum at each tick.
class TickClock {
 public:
  inline __attribute__((always_inline)) void advance_by_one_tick() {
    if (++ticks_ == kTicksPerMillisecond) {
      ticks_ = 0;
      ++milliseconds_;
      beat_ = beat_ + 1;
    }
  }

  // Ticks since the start; only of a copy that was taken with the step interrupt locked out, since
  // multiplying takes too long for that.
  uint32_t ticks() const { return milliseconds_ * kTicksPerMillisecond + ticks_; }

  // The low byte of the milliseconds, which can be read at any time.
  uint8_t beat() const { return static_cast<const volatile uint8_t&>(beat_); }

 private:
  uint8_t ticks_ = 0;
  uint8_t beat_ = 0;
  uint32_t milliseconds_ = 0;
};

}  // namespace plugpilot
