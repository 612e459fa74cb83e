#include "frames.hpp"

#include <string.h>

#include "crc16.hpp"

namespace plugpilot {
namespace {

constexpr uint8_t kSmallestFrame = protocol::HEADER_BYTES + protocol::CRC_BYTES;

}  // namespace

bool parse_frame(const uint8_t* bytes, uint8_t size, Frame& frame) {
  if (size < kSmallestFrame || bytes[0] != size) return false;
  const uint8_t payload_size = protocol::payload_bytes(bytes[1]);
  if (payload_size == protocol::UNKNOWN_TYPE || payload_size + kSmallestFrame != size) return false;
  const uint8_t covered = size - protocol::CRC_BYTES;
  const uint16_t crc = static_cast<uint16_t>(bytes[covered] | bytes[covered + 1] << 8);
  if (crc16(bytes, covered) != crc) return false;
  frame = Frame{bytes[1], bytes[2], bytes[3], bytes + protocol::HEADER_BYTES};
  return true;
}

bool send_frame(SendBuffer& buffer, const Frame& frame) {
  const uint8_t payload_size = protocol::payload_bytes(frame.type);
  const uint8_t covered = protocol::HEADER_BYTES + payload_size;
  const uint8_t size = covered + protocol::CRC_BYTES;
  const uint8_t on_the_wire = size + 2;
  if (buffer.room() < on_the_wire) return false;
  uint8_t bytes[kMaxFrameBytes] = {size, frame.type, frame.seq, frame.ack};
  memcpy(bytes + protocol::HEADER_BYTES, frame.payload, payload_size);
  const uint16_t crc = crc16(bytes, covered);
  bytes[covered] = static_cast<uint8_t>(crc);
  bytes[covered + 1] = static_cast<uint8_t>(crc >> 8);
  cobs_encode(bytes, size, [&buffer](uint8_t byte) { buffer.put(byte); });
  return true;
}

}  // namespace plugpilot
