// The host's end of the cable in real time: a pseudo terminal that stands for the serial port.
#pragma once
#include <cstdint>
#include <deque>
#include <string>

#include "serial_line.hpp"

namespace rig {

class Terminal {
 public:
  // Args: where the link to the terminal is put; the bits per second that the board talks.
  // Throws std::system_error.
  Terminal(SerialLine& line, std::string path, uint32_t baud);
  ~Terminal();

  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;

  // Move bytes between the terminal and the line. True if the host has opened it since the last
  // call: a pseudo terminal carries no DTR, so that stands for its edge.
  bool exchange(uint64_t now);

 private:
  void appear();
  void vanish();
  bool host_talks_at_our_speed() const;
  void read_from_host(uint64_t now);
  void write_to_host(uint64_t now);

  SerialLine& line_;
  std::string path_;
  uint32_t baud_;
  int master_ = -1;
  bool is_open_ = false;
  std::deque<uint8_t> leaving_;  // due, but the terminal was full
};

}  // namespace rig
