// The measured position and speed of rho3.
#pragma once
#include <stdint.h>

#include "protocol.hpp"

namespace plugpilot {

constexpr uint8_t kSpeedWindowMs = 16;  // short enough to damp with, long enough for a few counts

// Follows a hardware counter that only ever counts; coordinates are kept here.
class Encoder {
 public:
  // Once a millisecond: the hardware counter, in the direction in which rho3 grows.
  void sample(int32_t raw) {
    raw_ = raw;
    oldest_ = (oldest_ + 1) % kSpeedWindowMs;
    way_ = raw - history_[oldest_];
    history_[oldest_] = raw;
  }

  int32_t counts() const { return raw_ - zero_; }

  // The same place gets another coordinate.
  void renumber(int32_t counts) { zero_ = raw_ - counts; }

  // Mean over the window [2^-8 counts/ms].
  int32_t speed_q8() const { return way_ * (256 / kSpeedWindowMs); }

 private:
  int32_t raw_ = 0;
  int32_t zero_ = 0;
  int32_t way_ = 0;
  int32_t history_[kSpeedWindowMs] = {};
  uint8_t oldest_ = 0;
};

}  // namespace plugpilot
