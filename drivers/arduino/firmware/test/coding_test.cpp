// CRC, COBS and frames.
#include <cstring>
#include <random>
#include <vector>

#include "../core/crc16.hpp"
#include "../core/frames.hpp"
#include "check.hpp"

using namespace plugpilot;

namespace {

std::vector<uint8_t> encoded(const std::vector<uint8_t>& bytes) {
  std::vector<uint8_t> out;
  cobs_encode(bytes.data(), static_cast<uint8_t>(bytes.size()), [&](uint8_t b) { out.push_back(b); });
  return out;
}

}  // namespace

TEST(crc_of_the_check_string) { CHECK_EQUAL(crc16("123456789", 9), 0x29B1); }

TEST(cobs_of_known_strings) {
  CHECK(encoded({0}) == std::vector<uint8_t>({1, 1, 0}));
  CHECK(encoded({0x11, 0x22, 0, 0x33}) == std::vector<uint8_t>({3, 0x11, 0x22, 2, 0x33, 0}));
}

TEST(cobs_brings_every_frame_back) {
  std::mt19937 random(1);
  CobsDecoder<62> decoder;
  for (int round = 0; round < 5000; ++round) {
    std::vector<uint8_t> bytes(1 + random() % 62);
    for (uint8_t& byte : bytes) byte = random() % 3 ? random() : 0;
    uint8_t size = 0;
    const std::vector<uint8_t> wire = encoded(bytes);
    for (size_t i = 0; i < wire.size(); ++i) {
      CHECK((wire[i] == 0) == (i + 1 == wire.size()));
      size = decoder.feed(wire[i]);
    }
    CHECK_EQUAL(size, bytes.size());
    CHECK(std::memcmp(decoder.bytes(), bytes.data(), bytes.size()) == 0);
  }
  CHECK_EQUAL(decoder.dropped(), 0);
}

TEST(cobs_drops_what_is_broken_and_goes_on) {
  CobsDecoder<8> decoder;
  for (uint8_t byte : {5, 1, 2, 0}) CHECK_EQUAL(decoder.feed(byte), 0);  // cut off
  for (int i = 0; i < 20; ++i) decoder.feed(2);                          // too long
  CHECK_EQUAL(decoder.feed(0), 0);
  CHECK_EQUAL(decoder.dropped(), 2);
  decoder.feed(2);
  decoder.feed(7);
  CHECK_EQUAL(decoder.feed(0), 1);
}

TEST(a_frame_survives_only_whole) {
  SendBuffer wire;
  const protocol::Clock clock = {0x1234};
  const uint8_t type = static_cast<uint8_t>(protocol::MessageType::CLOCK);
  CHECK(send_frame(wire, {type, 7, 9, reinterpret_cast<const uint8_t*>(&clock)}));
  CobsDecoder<kMaxFrameBytes> decoder;
  uint8_t size = 0;
  while (!wire.empty()) size = decoder.feed(wire.take());
  Frame frame;
  CHECK(parse_frame(decoder.bytes(), size, frame));
  CHECK_EQUAL(frame.seq, 7);
  CHECK_EQUAL(frame.ack, 9);
  CHECK(std::memcmp(frame.payload, &clock, sizeof clock) == 0);
  for (int bit = 0; bit < size * 8; ++bit) {
    uint8_t damaged[kMaxFrameBytes];
    std::memcpy(damaged, decoder.bytes(), size);
    damaged[bit / 8] ^= 1 << bit % 8;
    CHECK(!parse_frame(damaged, size, frame));
  }
  CHECK(!parse_frame(decoder.bytes(), size - 1, frame));
}

TEST(a_frame_without_room_is_not_begun) {
  SendBuffer wire;
  const protocol::Telemetry telemetry = {};
  const Frame frame = {static_cast<uint8_t>(protocol::MessageType::TELEMETRY), 0, 0,
                       reinterpret_cast<const uint8_t*>(&telemetry)};
  int sent = 0;
  while (send_frame(wire, frame)) ++sent;
  CHECK(sent >= 4);
  const uint8_t room = wire.room();
  CHECK(!send_frame(wire, frame));
  CHECK_EQUAL(wire.room(), room);
}
