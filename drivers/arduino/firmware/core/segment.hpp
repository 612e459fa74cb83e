// Segments of constant acceleration in exact integers.
//
// A position is a 64-bit fixed-point number of steps or encoder counts with 31 binary digits behind
// the point; a rate is in 2^-31 units per tick, an acceleration in 2^-31 units per tick^2.
#pragma once
#include <stdint.h>

#include "protocol.hpp"

namespace plugpilot {

constexpr uint8_t kAxes = protocol::AXES;        // rho1, rho2, rho3
constexpr uint8_t kRails = protocol::STEP_AXES;  // the steppers among them, rho1 and rho2
constexpr uint8_t kSlide = 2;                    // rho3, the axis with an encoder
constexpr uint8_t kPhaseBits = protocol::PHASE_BITS;

constexpr int64_t kOneUnit = INT64_C(1) << kPhaseBits;
constexpr uint32_t kHalfUnit = static_cast<uint32_t>(kOneUnit / 2);

// A position in the middle of a unit: from there its whole part rounds to the nearest, not down.
constexpr int64_t centred(int32_t whole) { return whole * kOneUnit + kHalfUnit; }

// Shifts by anything but whole bytes are slow loops on the AVR, so the position is doubled first:
// then the whole units begin at a byte.
static_assert(kPhaseBits == 31, "the shifts below are by whole bytes");
constexpr uint64_t doubled(int64_t position) { return static_cast<uint64_t>(position) * 2; }

constexpr int32_t whole_part(int64_t position) {
  return static_cast<int32_t>(static_cast<uint32_t>(doubled(position) >> 32));
}

// [2^-8 units]; wraps beyond 2^23 units.
constexpr int32_t whole_part_q8(int64_t position) {
  return static_cast<int32_t>(static_cast<uint32_t>(doubled(position) >> 24));
}

constexpr uint32_t phase_part(int64_t position) {
  return static_cast<uint32_t>(position) & static_cast<uint32_t>(kOneUnit - 1);
}

// P(n) = start + n rate + acceleration n (n - 1) / 2: what n ticks of P += rate, rate +=
// acceleration give.
inline int64_t position_after(int64_t start, int32_t rate, int32_t acceleration, uint16_t ticks) {
  const uint32_t n = ticks;
  const int32_t pairs = n == 0 ? 0 : static_cast<int32_t>(n * (n - 1) / 2);
  const int32_t signed_ticks = ticks;
  return start + static_cast<int64_t>(rate) * signed_ticks +
         static_cast<int64_t>(acceleration) * pairs;
}

inline int64_t rate_after(int32_t rate, int32_t acceleration, uint16_t ticks) {
  return rate + static_cast<int64_t>(acceleration) * static_cast<int32_t>(ticks);
}

// The same where it is known to stay within 32 bits, and a fifth of the time.
inline int32_t rate_within_range(int32_t rate, int32_t acceleration, uint16_t ticks) {
  return static_cast<int32_t>(static_cast<uint32_t>(rate) +
                              static_cast<uint32_t>(acceleration) * ticks);
}

// One segment as the interpolator follows it. The rails go on from where they are; the slide,
// which is only looked at now and then, begins at slide_start.
struct Segment {
  uint16_t number;
  uint16_t ticks;
  int32_t rate[kAxes];
  int32_t acceleration[kAxes];
  int64_t slide_start;
  bool from_host;  // otherwise the board's own: a brake or a piece of homing
};

// Where a chain of segments ends.
struct QueueEnd {
  int64_t position[kAxes];
  int32_t rate[kAxes];

  // Goes on to the end of a segment whose rates stay within 32 bits.
  void append(const Segment& segment) {
    for (uint8_t axis = 0; axis < kAxes; ++axis) {
      position[axis] = position_after(position[axis], segment.rate[axis],
                                      segment.acceleration[axis], segment.ticks);
      rate[axis] =
          rate_within_range(segment.rate[axis], segment.acceleration[axis], segment.ticks);
    }
  }
};

}  // namespace plugpilot
