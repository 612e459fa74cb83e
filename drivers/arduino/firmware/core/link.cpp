#include "link.hpp"

#include <string.h>

#include "version.hpp"

namespace plugpilot {
namespace {

using protocol::MessageType;
using protocol::Refusal;

template <class Message>
Message read(const Frame& frame) {
  Message message;
  memcpy(&message, frame.payload, sizeof message);
  return message;
}

constexpr uint8_t kFromBoard = 0x80;  // in the type of everything that only a board sends

}  // namespace

void Link::receive(uint8_t byte) {
  const uint16_t dropped = decoder_.dropped();
  const uint8_t size = decoder_.feed(byte);
  if (decoder_.dropped() != dropped) ++damaged_;
  if (size == 0) return;
  Frame frame;
  if (!parse_frame(decoder_.bytes(), size, frame) || frame.type & kFromBoard) {
    ++damaged_;
    return;
  }
  board_.hear_host();
  handle(frame);
}

void Link::handle(const Frame& frame) {
  switch (static_cast<MessageType>(frame.type)) {
    case MessageType::HELLO_REQUEST: {
      const uint16_t session = read<protocol::HelloRequest>(frame).session;
      if (session != 0 && session != session_) begin_session(session);
      send_hello();
      break;
    }
    case MessageType::HEARTBEAT:
      break;
    case MessageType::CLOCK:
      send_clock(read<protocol::Clock>(frame));
      break;
    case MessageType::STOP: {
      const protocol::Stop message = read<protocol::Stop>(frame);
      // a category that does not exist cannot be refused here, so it gets the safer one
      const bool hold = message.category == protocol::StopCategory::DECELERATE_AND_HOLD;
      board_.stop(hold ? protocol::StopCategory::DECELERATE_AND_HOLD
                       : protocol::StopCategory::DECELERATE_AND_RELEASE);
      stop_token_ = message.token;
      send_ack();
      break;
    }
    case MessageType::EMERGENCY_STOP: {
      const protocol::EmergencyStop message = read<protocol::EmergencyStop>(frame);
      board_.emergency_stop(message.fault);
      stop_token_ = message.token;
      send_ack();
      break;
    }
    default:
      handle_sequenced(frame);
      break;
  }
}

// Go-back-N: only the next number counts; a number beyond it means that one was lost.
void Link::handle_sequenced(const Frame& frame) {
  if (session_ == 0) return;
  if (frame.seq == expected_) {
    ++expected_;
    const Refusal refusal = obey(frame);
    if (refusal != Refusal::NONE) refuse(frame.seq, refusal);
  }
  send_ack();
}

Refusal Link::obey(const Frame& frame) {
  const MessageType type = static_cast<MessageType>(frame.type);
  switch (type) {
    case MessageType::CONFIG_AXIS:
    case MessageType::CONFIG_RHO3:
    case MessageType::CONFIG_HOMING: {
      const Refusal refusal = board_.why_no_configuration();
      if (refusal != Refusal::NONE) return refusal;
      if (type == MessageType::CONFIG_AXIS) return draft_.put(read<protocol::ConfigAxis>(frame));
      if (type == MessageType::CONFIG_RHO3) draft_.put(read<protocol::ConfigRho3>(frame));
      if (type == MessageType::CONFIG_HOMING) draft_.put(read<protocol::ConfigHoming>(frame));
      return Refusal::NONE;
    }
    case MessageType::CONFIG_COMMIT:
      return commit(read<protocol::ConfigCommit>(frame));
    case MessageType::ENABLE:
      return board_.enable();
    case MessageType::DISABLE:
      return board_.disable();
    case MessageType::HOME:
      return board_.home();
    case MessageType::FORCE_LIMIT:
      return board_.limit_force(read<protocol::ForceLimit>(frame).force_dn);
    case MessageType::CLEAR_FAULT:
      return board_.clear_fault();
    case MessageType::SEGMENT:
      return board_.push(read<protocol::Segment>(frame));
    default:
      return Refusal::BAD_VALUE;
  }
}

Refusal Link::commit(const protocol::ConfigCommit& message) {
  Refusal refusal = board_.why_no_configuration();
  if (refusal == Refusal::NONE) refusal = draft_.complete(message.crc);
  if (refusal == Refusal::NONE) refusal = board_.configure(draft_.parts());
  if (refusal == Refusal::NONE && message.save == 1) save_requested_ = true;
  return refusal;
}

bool Link::take_save_request() {
  const bool requested = save_requested_;
  save_requested_ = false;
  return requested;
}

void Link::begin_session(uint16_t session) {
  session_ = session;
  expected_ = events_ = refused_seq_ = stop_token_ = 0;
  refusal_ = Refusal::NONE;
  draft_ = ConfigurationDraft();
  board_.begin_session();
}

void Link::refuse(uint8_t seq, Refusal refusal) {
  refused_seq_ = seq;
  refusal_ = refusal;
  protocol::Event event = {protocol::EventKind::REFUSED, static_cast<uint8_t>(refusal), seq, 0,
                           board_.interpolator().set_point().tick};
  send_event(event);
}

void Link::every_millisecond() {
  protocol::Event event;
  while (board_.take_event(event)) send_event(event);
  ++quiet_ms_;
  if (session_ == 0) {
    if (quiet_ms_ < protocol::HELLO_PERIOD_MS) return;
    send_hello();
  } else {
    const uint8_t period =
        board_.moving() ? protocol::TELEMETRY_MOVING_MS : protocol::TELEMETRY_REST_MS;
    if (quiet_ms_ < period) return;
    send_telemetry();
  }
  quiet_ms_ = 0;
}

// Without room in the buffer the frame is lost; everything in it is told again or missed.
void Link::send(MessageType type, const void* payload, uint8_t seq) {
  send_frame(out_, Frame{static_cast<uint8_t>(type), seq, expected_,
                         static_cast<const uint8_t*>(payload)});
}

void Link::send_hello() {
  const protocol::Hello hello = {protocol::PROTOCOL_HASH,
                                 session_,
                                 protocol::BoardKind::ME_AURIGA,
                                 kFirmwareMajor,
                                 kFirmwareMinor,
                                 kFirmwarePatch,
                                 identity_.boot_id,
                                 identity_.reset_cause,
                                 identity_.previous_fault,
                                 board_.state(),
                                 protocol::QUEUE_CAPACITY,
                                 protocol::SEGMENT_TICKS,
                                 protocol::TICK_HZ,
                                 board_.config_crc(),
                                 board_.interpolator().set_point().tick};
  send(MessageType::HELLO, &hello);
}

void Link::send_clock(const protocol::Clock& request) {
  const protocol::ClockReply reply = {request.token, board_.interpolator().set_point().tick};
  send(MessageType::CLOCK_REPLY, &reply);
}

void Link::send_ack() {
  const protocol::Ack ack = {events_, refused_seq_, refusal_, stop_token_};
  send(MessageType::ACK, &ack);
}

void Link::send_event(protocol::Event& event) {
  if (session_ != 0) send(MessageType::EVENT, &event, events_++);
}

void Link::send_telemetry() {
  protocol::Telemetry telemetry = {};
  board_.report(telemetry);
  telemetry.flags |= noted_;
  telemetry.bad_frames = damaged_;
  telemetry.events = events_;
  telemetry.refused_seq = refused_seq_;
  telemetry.refusal = refusal_;
  telemetry.stop_token = stop_token_;
  noted_ = 0;
  send(MessageType::TELEMETRY, &telemetry);
}

}  // namespace plugpilot
