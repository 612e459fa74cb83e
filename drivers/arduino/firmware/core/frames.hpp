// Frames: length, type, seq, ack, payload, CRC; see protocol/README.md.
#pragma once
#include "cobs.hpp"
#include "protocol.hpp"
#include "ring_buffer.hpp"

namespace plugpilot {

// Room of a frame between COBS coding and the wire: one code byte and the delimiter less.
constexpr uint8_t kMaxFrameBytes = protocol::MAX_FRAME_BYTES - 2;

struct Frame {
  uint8_t type;
  uint8_t seq;
  uint8_t ack;
  const uint8_t* payload;  // as long as the type says
};

// False if the length, the type, the payload's size or the CRC is wrong.
bool parse_frame(const uint8_t* bytes, uint8_t size, Frame& frame);

// Encodes a frame into a buffer; false, and nothing written, if there is no room.
bool send_frame(SendBuffer& buffer, const Frame& frame);

}  // namespace plugpilot
