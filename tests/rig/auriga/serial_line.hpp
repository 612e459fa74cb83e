// The USB cable and its bridge: bytes on their way, and what a bad cable does to them.
#pragma once
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <random>

namespace rig {

// What a bad cable does, as chances per byte.
struct LineFaults {
  double lose = 0;
  double flip = 0;
  double duplicate = 0;
  double delay_s = 0;  // of every byte, beside the bridge's own
};

// What it has done, in bytes.
struct Damage {
  uint64_t lost = 0;
  uint64_t flipped = 0;
  uint64_t duplicated = 0;
  uint64_t delayed = 0;
};

// One direction.
class ByteQueue {
 public:
  void put(uint8_t byte, uint64_t due) { bytes_.push_back({due, byte}); }

  // The oldest byte if its delay is over.
  std::optional<uint8_t> take(uint64_t now);

  // When the oldest byte is due.
  std::optional<uint64_t> next_due() const;
  bool empty() const { return bytes_.empty(); }
  void clear() { bytes_.clear(); }

 private:
  struct Late {
    uint64_t due;
    uint8_t byte;
  };
  std::deque<Late> bytes_;
};

class SerialLine {
 public:
  // Args: how long a byte is under way.
  explicit SerialLine(double latency_s) : latency_s_(latency_s) {}

  SerialLine(const SerialLine&) = delete;
  SerialLine& operator=(const SerialLine&) = delete;

  void send_to_board(uint8_t byte, uint64_t now);
  void send_to_host(uint8_t byte, uint64_t now);
  ByteQueue& to_board() { return to_board_; }
  ByteQueue& to_host() { return to_host_; }

  // Call when the board has sent the byte that ends a frame.
  void on_frame_sent(std::function<void()> action) { on_frame_sent_ = std::move(action); }

  void set_faults(const LineFaults& faults) { faults_ = faults; }
  const Damage& damage() const { return damage_; }
  void cut(bool is_cut) { is_cut_ = is_cut; }

  // Take the whole device away and bring it back, as pulling the plug does.
  void unplug();
  void plug_in() { is_plugged_ = true; }
  bool is_plugged() const { return is_plugged_; }

  void note_wrong_baud(uint64_t bytes) { wrong_baud_ += bytes; }
  uint64_t bytes_to_board() const { return bytes_to_board_; }
  uint64_t bytes_to_host() const { return bytes_to_host_; }
  uint64_t wrong_baud() const { return wrong_baud_; }

 private:
  void carry(uint8_t byte, uint64_t now, ByteQueue& queue);
  bool happens(double share);

  double latency_s_;
  bool is_cut_ = false;
  bool is_plugged_ = true;
  LineFaults faults_;
  Damage damage_;
  std::mt19937 chance_{1};
  ByteQueue to_board_;
  ByteQueue to_host_;
  std::function<void()> on_frame_sent_ = [] {};
  uint64_t bytes_to_board_ = 0;
  uint64_t bytes_to_host_ = 0;
  uint64_t wrong_baud_ = 0;
};

}  // namespace rig
