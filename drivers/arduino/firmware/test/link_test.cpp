// Sessions, the numbered sequence, and what the board tells, over bytes as on the wire.
#include <cstring>
#include <vector>

#include "../core/link.hpp"
#include "check.hpp"
#include "stand.hpp"

using namespace stand;
using protocol::MessageType;
using protocol::Refusal;
using protocol::State;

namespace {

struct Received {
  MessageType type;
  uint8_t seq;
  uint8_t ack;
  std::vector<uint8_t> payload;

  template <class Message>
  Message as() const {
    Message message;
    CHECK_EQUAL(payload.size(), sizeof message);
    std::memcpy(&message, payload.data(), sizeof message);
    return message;
  }
};

// A host at the other end of the cable.
class Host {
 public:
  explicit Host(bool configured = true) : stand(configured), link(stand.board, out_) {
    stand.host_alive = false;
  }

  template <class Message>
  void send(MessageType type, const Message& message, int seq = 0) {
    send_bytes(type, &message, seq);
  }
  void send(MessageType type, int seq = 0) { send_bytes(type, "", seq); }

  void begin(uint16_t session) {
    send(MessageType::HELLO_REQUEST, protocol::HelloRequest{protocol::PROTOCOL_HASH, session});
  }

  void run(int milliseconds) {
    for (int i = 0; i < milliseconds; ++i) {
      stand.millisecond();
      link.every_millisecond();
      while (link.tell()) {
      }
      collect();
    }
  }

  std::vector<Received> all(MessageType type) const {
    std::vector<Received> found;
    for (const Received& frame : received) {
      if (frame.type == type) found.push_back(frame);
    }
    return found;
  }
  Received last(MessageType type) const {
    const std::vector<Received> found = all(type);
    CHECK(!found.empty());
    return found.empty() ? Received{} : found.back();
  }

  void collect() {
    while (!out_.empty()) {
      const uint8_t size = decoder_.feed(out_.take());
      Frame frame;
      if (size == 0) continue;
      CHECK(parse_frame(decoder_.bytes(), size, frame));
      const uint8_t* end = frame.payload + protocol::payload_bytes(frame.type);
      received.push_back({static_cast<MessageType>(frame.type), frame.seq, frame.ack,
                          std::vector<uint8_t>(frame.payload, end)});
    }
  }

  Stand stand;
  std::vector<Received> received;

 private:
  SendBuffer out_;
  CobsDecoder<kMaxFrameBytes> decoder_;

 public:
  Link link;

 private:
  void send_bytes(MessageType type, const void* payload, int seq) {
    SendBuffer wire;
    CHECK(send_frame(wire, {static_cast<uint8_t>(type), static_cast<uint8_t>(seq), 0,
                            static_cast<const uint8_t*>(payload)}));
    while (!wire.empty()) link.receive(wire.take());
    collect();
  }
};

// The messages of a whole configuration, from sequence number 0.
void send_configuration(Host& host, const Configuration& c, uint16_t crc, bool save) {
  for (int i = 0; i < 3; ++i) host.send(MessageType::CONFIG_AXIS, c.axis[i], i);
  host.send(MessageType::CONFIG_RHO3, c.rho3, 3);
  host.send(MessageType::CONFIG_HOMING, c.homing, 4);
  host.send(MessageType::CONFIG_COMMIT, protocol::ConfigCommit{crc, save}, 5);
}

}  // namespace

TEST(a_board_without_a_session_says_hello_only) {
  Host host;
  host.run(1100);
  CHECK_EQUAL(host.received.size(), 3);
  const auto hello = host.last(MessageType::HELLO).as<protocol::Hello>();
  CHECK_EQUAL(hello.protocol_hash, protocol::PROTOCOL_HASH);
  CHECK_EQUAL(hello.session, 0);
  host.send(MessageType::ENABLE, 0);
  CHECK_EQUAL(host.stand.board.state(), State::IDLE);
  CHECK(host.all(MessageType::ACK).empty());
  host.begin(0);
  CHECK_EQUAL(host.last(MessageType::HELLO).as<protocol::Hello>().session, 0);
}

TEST(the_same_session_again_changes_nothing) {
  Host host;
  host.begin(7);
  CHECK_EQUAL(host.last(MessageType::HELLO).as<protocol::Hello>().session, 7);
  host.send(MessageType::ENABLE, 0);
  host.begin(7);
  CHECK_EQUAL(host.last(MessageType::HELLO).ack, 1);
  host.begin(8);
  CHECK_EQUAL(host.last(MessageType::HELLO).ack, 0);
}

TEST(only_the_next_number_is_obeyed_and_each_is_answered) {
  Host host;
  host.begin(1);
  host.send(MessageType::ENABLE, 1);  // 0 was lost
  CHECK_EQUAL(host.stand.board.state(), State::IDLE);
  CHECK_EQUAL(host.last(MessageType::ACK).ack, 0);
  host.send(MessageType::ENABLE, 0);
  CHECK_EQUAL(host.stand.board.state(), State::READY);
  host.send(MessageType::DISABLE, 0);  // sent again
  CHECK_EQUAL(host.stand.board.state(), State::READY);
  host.send(MessageType::DISABLE, 1);
  CHECK_EQUAL(host.stand.board.state(), State::IDLE);
  CHECK_EQUAL(host.last(MessageType::ACK).ack, 2);
  CHECK_EQUAL(host.all(MessageType::ACK).size(), 4);
}

TEST(sequence_numbers_wrap) {
  Host host;
  host.begin(1);
  for (int i = 0; i < 600; ++i) {
    host.send(i % 2 ? MessageType::DISABLE : MessageType::ENABLE, i);
    CHECK_EQUAL(host.stand.board.state(), i % 2 ? State::IDLE : State::READY);
  }
}

TEST(a_refusal_is_told_twice_and_counted_as_handled) {
  Host host;
  host.begin(1);
  host.send(MessageType::HOME, 0);
  const auto events = host.all(MessageType::EVENT);
  CHECK_EQUAL(events.size(), 1);
  const auto event = events[0].as<protocol::Event>();
  CHECK_EQUAL(event.kind, protocol::EventKind::REFUSED);
  CHECK_EQUAL(event.code, Refusal::DRIVES_OFF);
  CHECK_EQUAL(events[0].seq, 0);
  const Received ack = host.last(MessageType::ACK);
  CHECK_EQUAL(ack.ack, 1);
  CHECK_EQUAL(ack.as<protocol::Ack>().refusal, Refusal::DRIVES_OFF);
  CHECK_EQUAL(ack.as<protocol::Ack>().refused_seq, 0);
  CHECK_EQUAL(ack.as<protocol::Ack>().events, 1);
}

TEST(a_stop_is_honoured_outside_the_sequence) {
  Host host;
  host.stand.host_alive = true;
  host.stand.home();
  host.begin(1);
  for (int i = 0; i < 8; ++i) host.stand.ramp(2000, 0, 0);
  host.run(30);
  host.send(MessageType::STOP, protocol::Stop{protocol::StopCategory::DECELERATE_AND_HOLD, 9}, 200);
  CHECK_EQUAL(host.stand.board.state(), State::STOPPING);
  CHECK_EQUAL(host.last(MessageType::ACK).as<protocol::Ack>().stop_token, 9);
  CHECK_EQUAL(host.last(MessageType::ACK).ack, 0);
  host.send(MessageType::EMERGENCY_STOP, protocol::EmergencyStop{protocol::Fault::NONE, 10}, 77);
  CHECK_EQUAL(host.stand.board.fault(), protocol::Fault::EMERGENCY_STOP);
  CHECK_EQUAL(host.last(MessageType::ACK).as<protocol::Ack>().stop_token, 10);
  host.run(1);
  const auto event = host.last(MessageType::EVENT).as<protocol::Event>();
  CHECK_EQUAL(event.kind, protocol::EventKind::FAULT_LATCHED);
}

TEST(a_configuration_is_in_force_only_whole) {
  const Configuration c = configuration();
  Host host(false);
  host.begin(1);
  send_configuration(host, c, c.crc() + 1, true);
  CHECK_EQUAL(host.last(MessageType::ACK).as<protocol::Ack>().refusal, Refusal::CONFIG_CRC);
  CHECK_EQUAL(host.stand.board.state(), State::BOOT);
  CHECK(!host.link.take_save_request());
  host.begin(2);
  send_configuration(host, c, c.crc(), true);
  CHECK_EQUAL(host.stand.board.state(), State::IDLE);
  CHECK(host.link.take_save_request());
  CHECK(!host.link.take_save_request());
  host.begin(3);
  host.send(MessageType::CONFIG_COMMIT, protocol::ConfigCommit{c.crc(), 0}, 0);
  CHECK_EQUAL(host.last(MessageType::ACK).as<protocol::Ack>().refusal, Refusal::CONFIG_CRC);
  CHECK_EQUAL(host.last(MessageType::HELLO).as<protocol::Hello>().config_crc, c.crc());
}

TEST(telemetry_comes_fast_in_motion_and_slowly_at_rest) {
  Host host;
  host.stand.host_alive = true;
  host.begin(1);
  host.run(1000);
  CHECK_EQUAL(host.all(MessageType::TELEMETRY).size(), 10);
  host.stand.board.enable();
  host.stand.board.home();
  host.received.clear();
  host.run(1000);
  // and two at once, when the drives went on and when homing began
  CHECK(host.all(MessageType::TELEMETRY).size() >= 100);
  CHECK(host.all(MessageType::TELEMETRY).size() <= 102);
  const auto telemetry = host.last(MessageType::TELEMETRY).as<protocol::Telemetry>();
  CHECK_EQUAL(telemetry.state, State::HOMING);
  CHECK(telemetry.flags & protocol::MOVING);
}

TEST(a_change_is_told_at_once) {
  Host host;
  host.stand.host_alive = true;
  host.begin(1);
  host.run(150);
  const auto told_within = [&](int milliseconds) {
    host.received.clear();
    host.run(milliseconds);
    return host.all(MessageType::TELEMETRY).size();
  };
  host.run(5);
  host.stand.board.enable();
  CHECK_EQUAL(told_within(2), 1);
  CHECK(host.last(MessageType::TELEMETRY).as<protocol::Telemetry>().flags & protocol::ENABLED);
  CHECK_EQUAL(told_within(5), 0);
  host.stand.cut = 1;
  CHECK_EQUAL(told_within(2), 1);
  host.run(5);
  host.stand.board.emergency_stop(protocol::Fault::EMERGENCY_STOP);
  told_within(2);
  CHECK_EQUAL(host.last(MessageType::TELEMETRY).as<protocol::Telemetry>().state, State::FAULT);
}

TEST(a_bouncing_switch_does_not_flood_the_line) {
  Host host;
  host.stand.host_alive = true;
  host.begin(1);
  host.received.clear();
  for (int i = 0; i < 100; ++i) {
    host.stand.cut = i % 2;
    host.run(1);
  }
  CHECK(host.all(MessageType::TELEMETRY).size() <= 51);
}

TEST(a_host_of_another_version_may_only_stop) {
  Host host;
  host.stand.host_alive = true;
  host.stand.home();
  for (int i = 0; i < 8; ++i) host.stand.ramp(2000, 0, 0);
  host.run(30);
  host.send(MessageType::HELLO_REQUEST, protocol::HelloRequest{0x12345678, 77});
  const auto hello = host.last(MessageType::HELLO).as<protocol::Hello>();
  CHECK_EQUAL(hello.session, 77);  // so that the host knows the answer for its own
  CHECK_EQUAL(hello.protocol_hash, protocol::PROTOCOL_HASH);
  host.send(MessageType::ENABLE, 0);
  CHECK(host.all(MessageType::ACK).empty());
  host.run(100);
  CHECK(host.all(MessageType::TELEMETRY).empty());
  CHECK_EQUAL(host.stand.board.state(), State::RUN);
  host.send(MessageType::STOP, protocol::Stop{protocol::StopCategory::DECELERATE_AND_HOLD, 9});
  CHECK_EQUAL(host.stand.board.state(), State::STOPPING);
}

TEST(damaged_frames_are_counted_and_do_not_keep_the_robot_alive) {
  Host host;
  host.begin(1);
  host.send(MessageType::ENABLE, 0);
  for (int i = 0; i < 250; ++i) {
    for (uint8_t byte : {3, 0x55, 0x55, 0}) host.link.receive(byte);
    host.run(1);
  }
  CHECK_EQUAL(host.stand.board.fault(), protocol::Fault::HEARTBEAT_LOST);
  CHECK_EQUAL(host.last(MessageType::TELEMETRY).as<protocol::Telemetry>().bad_frames != 0, true);
  Host alive;
  alive.begin(1);
  alive.send(MessageType::ENABLE, 0);
  for (int i = 0; i < 10; ++i) {
    alive.send(MessageType::HEARTBEAT);
    alive.run(150);
  }
  CHECK_EQUAL(alive.stand.board.state(), State::READY);
}
