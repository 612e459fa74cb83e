// CRC-16-CCITT-FALSE: polynomial 0x1021, start 0xFFFF, no reflection, no final inversion.
#pragma once
#include <stdint.h>

namespace plugpilot {

constexpr uint16_t kCrcStart = 0xFFFF;

// One byte more. The shifts replace a table: they are the polynomial for eight bits at once.
inline uint16_t crc16_step(uint16_t crc, uint8_t byte) {
  uint8_t x = static_cast<uint8_t>(crc >> 8) ^ byte;
  x ^= static_cast<uint8_t>(x >> 4);
  return static_cast<uint16_t>((crc << 8) ^ (static_cast<uint16_t>(x) << 12) ^
                               (static_cast<uint16_t>(x) << 5) ^ x);
}

inline uint16_t crc16(const void* data, uint16_t size, uint16_t crc = kCrcStart) {
  const uint8_t* bytes = static_cast<const uint8_t*>(data);
  for (uint16_t i = 0; i < size; ++i) crc = crc16_step(crc, bytes[i]);
  return crc;
}

}  // namespace plugpilot
