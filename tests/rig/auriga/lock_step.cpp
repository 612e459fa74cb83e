#include "lock_step.hpp"

#include <algorithm>
#include <cinttypes>
#include <cstdio>
#include <iostream>
#include <sstream>
#include <stdexcept>

#include "commands.hpp"
#include "report.hpp"

namespace rig {

LockStep::LockStep(Board& board, double began_s, double sample_s)
    : board_(board), began_s_(began_s), sample_cycles_(static_cast<uint64_t>(sample_s * kCpuHz)) {
  board.line.on_frame_sent([&board] { board.mcu.interrupt(); });
}

double LockStep::time_s(uint64_t cycle) const {
  return began_s_ + static_cast<double>(cycle) / kCpuHz;
}

void LockStep::serve() {
  std::cout << "ready" << std::endl;
  for (std::string line; std::getline(std::cin, line);) {
    try {
      std::cout << answer(line) << std::endl;
    } catch (const std::invalid_argument& error) {
      std::cout << error_json(error.what()) << std::endl;
    }
  }
}

std::string LockStep::answer(const std::string& line) {
  std::istringstream words(line);
  std::string verb;
  words >> verb;
  if (verb == "run") {
    uint64_t until = 0;
    words >> until;
    if (!words) throw std::invalid_argument("run: until which cycle?");
    return run(until);
  }
  if (verb == "write") {
    std::string hex;
    words >> hex;
    write(hex);
  } else if (verb == "open") {
    open();
  } else if (verb == "close") {
    is_open_ = false;
  } else {
    return obey(line, board_, *this);
  }
  return "{}";
}

std::string LockStep::run(uint64_t until) {
  std::string sample = "null";
  bool frame = false;
  const bool lost = is_open_ && !board_.line.is_plugged();
  if (lost) {
    is_open_ = false;
    received_.clear();
    until = board_.mcu.now();  // the host learns it at once
  }
  do {
    board_.mcu.run_until(next_stop(until));
    frame = collect();
    if (board_.mcu.now() < next_sample_) continue;
    next_sample_ += sample_cycles_;
    sample = state_json(board_, *this);
    break;
  } while (!frame && board_.mcu.now() < until);
  std::string text = "{\"cycle\":" + std::to_string(board_.mcu.now()) + ",\"received\":\"" +
                     received_ + "\",\"sample\":" + sample +
                     ",\"lost\":" + (lost ? "true" : "false") + "}";
  received_.clear();
  return text;
}

uint64_t LockStep::next_stop(uint64_t until) {
  return std::min({until, next_sample_, board_.line.to_host().next_due().value_or(until)});
}

// What the board has sent and the cable has carried; true if a frame has ended.
bool LockStep::collect() {
  bool frame = false;
  while (const auto byte = board_.line.to_host().take(board_.mcu.now())) {
    if (!is_open_ || !board_.line.is_plugged()) continue;
    char digits[3];
    snprintf(digits, sizeof digits, "%02x", *byte);
    received_ += digits;
    frame = frame || *byte == 0;
  }
  return frame;
}

void LockStep::write(const std::string& hex) {
  if (hex.empty() || hex.size() % 2 != 0 ||
      hex.find_first_not_of("0123456789abcdef") != std::string::npos) {
    throw std::invalid_argument("write: bytes as pairs of hexadecimal digits");
  }
  if (!is_open_ || !board_.line.is_plugged()) throw std::invalid_argument("the port is not open");
  for (size_t i = 0; i < hex.size(); i += 2) {
    const auto byte = static_cast<uint8_t>(std::stoi(hex.substr(i, 2), nullptr, 16));
    board_.line.send_to_board(byte, board_.mcu.now());
  }
  board_.uart.kick();
}

void LockStep::open() {
  if (!board_.line.is_plugged()) throw std::invalid_argument("there is no such device");
  if (is_open_) throw std::invalid_argument("the device is busy");
  is_open_ = true;
  received_.clear();
  board_.press_reset();
}

}  // namespace rig
