// Whether the slide has come to where its set point rests.
#pragma once
#include <stdint.h>

#include "protocol.hpp"

namespace plugpilot {

// It may pass through its place with some speed, so it has to stand there for a while; and it may
// stop short for good, so that is noticed, too.
class Arrival {
 public:
  enum class Answer : uint8_t {
    WAITING,
    ARRIVED,
    MISSED,  // it will not come nearer by itself
  };

  // One millisecond.
  //
  // Args: whether the set point moves, or is about to; the encoder; set point minus encoder.
  Answer update(bool moving, int32_t counts, int32_t error, const protocol::ConfigRho3& numbers) {
    const int32_t distance = error < 0 ? -error : error;
    still_ms_ = counts == last_counts_ ? one_more(still_ms_) : 0;
    within_ms_ = distance <= numbers.settled ? one_more(within_ms_) : 0;
    waited_ms_ = moving ? 0 : one_more(waited_ms_);
    last_counts_ = counts;
    if (moving) return Answer::WAITING;
    if (smaller(still_ms_, within_ms_) >= protocol::ARRIVED_MS) return Answer::ARRIVED;
    if (smaller(still_ms_, waited_ms_) >= protocol::ARRIVAL_STANDSTILL_MS ||
        waited_ms_ >= protocol::ARRIVAL_TIMEOUT_MS) {
      return distance <= numbers.near ? Answer::ARRIVED : Answer::MISSED;
    }
    return Answer::WAITING;
  }

 private:
  static uint16_t one_more(uint16_t ms) { return ms < UINT16_MAX ? ms + 1 : ms; }
  static uint16_t smaller(uint16_t a, uint16_t b) { return a < b ? a : b; }

  int32_t last_counts_ = 0;
  uint16_t still_ms_ = 0;
  uint16_t within_ms_ = 0;
  uint16_t waited_ms_ = 0;
};

}  // namespace plugpilot
