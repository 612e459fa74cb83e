// The USB cable and its bridge: a pseudo terminal on the host's side, bytes in time on the other.
#pragma once
#include <cstdint>
#include <deque>
#include <optional>
#include <random>
#include <string>

namespace rig {

// What a bad cable does, as chances per byte.
struct LineFaults {
  double lose = 0;
  double flip = 0;
  double duplicate = 0;
  double delay_s = 0;  // of every byte
};

// One direction.
class ByteQueue {
 public:
  void put(uint8_t byte, uint64_t now, const LineFaults& faults, std::mt19937& chance);

  // The oldest byte if its delay is over.
  std::optional<uint8_t> take(uint64_t now);
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
  // Args: where the link to the terminal is put; the bits per second that the board talks.
  // Throws std::system_error.
  SerialLine(std::string path, uint32_t baud);
  ~SerialLine();

  SerialLine(const SerialLine&) = delete;
  SerialLine& operator=(const SerialLine&) = delete;

  // Move bytes between the terminal and the queues. True if the host has opened it since the last
  // call: a pseudo terminal carries no DTR, so that stands for its edge.
  bool exchange(uint64_t now);

  ByteQueue& to_board() { return to_board_; }
  void send_to_host(uint8_t byte, uint64_t now);

  void set_faults(const LineFaults& faults) { faults_ = faults; }
  const LineFaults& faults() const { return faults_; }
  void cut(bool is_cut) { is_cut_ = is_cut; }

  // Take the whole device away and bring it back, as pulling the plug does.
  void unplug();
  void plug_in();

  uint64_t bytes_to_board() const { return bytes_to_board_; }
  uint64_t bytes_to_host() const { return bytes_to_host_; }
  uint64_t wrong_baud() const { return wrong_baud_; }

 private:
  bool host_talks_at_our_speed() const;
  void read_from_host(uint64_t now);
  void write_to_host(uint64_t now);

  std::string path_;
  uint32_t baud_;
  int master_ = -1;
  bool is_open_ = false;
  bool is_cut_ = false;
  LineFaults faults_;
  std::mt19937 chance_{1};
  ByteQueue to_board_;
  ByteQueue to_host_;
  std::deque<uint8_t> leaving_;  // due, but the terminal was full
  uint64_t bytes_to_board_ = 0;
  uint64_t bytes_to_host_ = 0;
  uint64_t wrong_baud_ = 0;
};

}  // namespace rig
