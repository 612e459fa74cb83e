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

bool Link::receive(uint8_t byte) {
  const uint16_t dropped = decoder_.dropped();
  const uint8_t size = decoder_.feed(byte);
  if (decoder_.dropped() != dropped) ++damaged_;
  if (size == 0) return false;
  Frame frame;
  if (!parse_frame(decoder_.bytes(), size, frame) || frame.type & kFromBoard) {
    ++damaged_;
    return true;
  }
  board_.hear_host();
  handle(frame);
  return true;
}

void Link::handle(const Frame& frame) {
  switch (static_cast<MessageType>(frame.type)) {
    case MessageType::HELLO_REQUEST:
      answer_hello(read<protocol::HelloRequest>(frame));
      break;
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

// A host that speaks another version learns who this is, and nothing else happens: its messages
// would mean something else here. It may still stop the robot.
void Link::answer_hello(const protocol::HelloRequest& request) {
  const bool understood = request.protocol_hash == protocol::PROTOCOL_HASH;
  if (understood && request.session != 0 && request.session != session_) {
    begin_session(request.session);
  }
  send_hello(understood ? session_ : request.session);
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
  if (quiet_ms_ < UINT16_MAX) ++quiet_ms_;
  due_ = session_ == 0 ? quiet_ms_ >= protocol::HELLO_PERIOD_MS : is_telemetry_due();
}

bool Link::tell() {
  protocol::Event event;
  if (board_.take_event(event)) {
    send_event(event);
    return true;
  }
  if (!due_) return false;
  due_ = false;
  quiet_ms_ = 0;
  if (session_ == 0) {
    send_hello(session_);
  } else {
    send_telemetry();
  }
  return true;
}

bool Link::is_telemetry_due() const {
  if (quiet_ms_ < protocol::TELEMETRY_CHANGE_MS) return false;
  if (quiet_ms_ >= (board_.moving() ? protocol::TELEMETRY_MOVING_MS : protocol::TELEMETRY_REST_MS))
    return true;
  // in motion the force comes and goes with every count
  const uint16_t changed = (board_.flags() ^ told_flags_) & ~protocol::FORCE_LIMITED;
  return changed != 0 || board_.state() != told_state_ || board_.fault() != told_fault_;
}

// Without room in the buffer the frame is lost; everything in it is told again or missed.
void Link::send(MessageType type, const void* payload, uint8_t seq) {
  send_frame(out_, Frame{static_cast<uint8_t>(type), seq, expected_,
                         static_cast<const uint8_t*>(payload)});
}

void Link::send_hello(uint16_t session) {
  const protocol::Hello hello = {protocol::PROTOCOL_HASH,
                                 session,
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
  told_state_ = telemetry.state;
  told_fault_ = telemetry.fault;
  told_flags_ = telemetry.flags;
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
