// The board's end of the link: sessions, the numbered sequence, and what is told without asking.
#pragma once
#include "board.hpp"
#include "frames.hpp"

namespace plugpilot {

// Who the board is, as HELLO tells it.
struct BoardIdentity {
  uint16_t boot_id;
  protocol::ResetCause reset_cause;
  protocol::Fault previous_fault;
};

class Link {
 public:
  Link(Board& board, SendBuffer& out) : board_(board), out_(out) {}

  void introduce(const BoardIdentity& identity) { identity_ = identity; }

  // True if the byte has completed a frame, whatever has come of it.
  bool receive(uint8_t byte);
  void every_millisecond();

  // Sends one of the frames that are due, if any; true if it has.
  bool tell();

  // Told once with the next telemetry.
  void note_late_tick() { noted_ |= protocol::LATE_TICK; }
  void note_overrun() { noted_ |= protocol::RX_OVERRUN; }

  // The configuration in force is to be kept; asked once.
  bool take_save_request();

 private:
  void handle(const Frame& frame);
  void handle_sequenced(const Frame& frame);
  protocol::Refusal obey(const Frame& frame);
  protocol::Refusal commit(const protocol::ConfigCommit& message);
  void answer_hello(const protocol::HelloRequest& request);
  void begin_session(uint16_t session);
  bool is_telemetry_due() const;
  void refuse(uint8_t seq, protocol::Refusal refusal);
  void send(protocol::MessageType type, const void* payload, uint8_t seq = 0);
  void send_hello(uint16_t session);
  void send_clock(const protocol::Clock& request);
  void send_ack();
  void send_event(protocol::Event& event);
  void send_telemetry();

  Board& board_;
  SendBuffer& out_;
  BoardIdentity identity_ = {};
  CobsDecoder<kMaxFrameBytes> decoder_;
  ConfigurationDraft draft_;
  uint16_t session_ = 0;
  uint8_t expected_ = 0;
  uint8_t events_ = 0;
  uint8_t refused_seq_ = 0;
  protocol::Refusal refusal_ = protocol::Refusal::NONE;
  uint8_t stop_token_ = 0;
  uint8_t damaged_ = 0;
  uint16_t noted_ = 0;
  bool save_requested_ = false;
  uint16_t quiet_ms_ = protocol::HELLO_PERIOD_MS;  // since the last telemetry, or HELLO
  bool due_ = false;
  protocol::State told_state_ = protocol::State::BOOT;
  protocol::Fault told_fault_ = protocol::Fault::NONE;
  uint16_t told_flags_ = 0;
};

}  // namespace plugpilot
