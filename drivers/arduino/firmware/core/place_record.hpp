// Where the robot stood, kept over a loss of power. Homing chooses its height from it.
#pragma once
#include <stdint.h>

#include "crc16.hpp"
#include "protocol.hpp"

namespace plugpilot {

constexpr uint8_t kPlaceRecords = 32;  // written in turn, so that each cell lasts 32 times longer

struct __attribute__((packed)) PlaceRecord {
  uint8_t serial;  // the one after the newest is the oldest
  int32_t position[protocol::AXES];
  uint16_t crc;

  void seal() { crc = crc16(this, sizeof *this - sizeof crc); }
  bool is_whole() const { return crc == crc16(this, sizeof *this - sizeof crc); }

  // Whether this was written after the other; serials wrap.
  bool is_newer_than(const PlaceRecord& other) const {
    return static_cast<int8_t>(serial - other.serial) > 0;
  }
};

}  // namespace plugpilot
