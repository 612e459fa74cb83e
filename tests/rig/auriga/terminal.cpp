#include "terminal.hpp"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <stdlib.h>
#include <termios.h>
#include <unistd.h>

#include <stdexcept>
#include <system_error>

namespace rig {
namespace {

[[noreturn]] void fail(const char* what) {
  throw std::system_error(errno, std::generic_category(), what);
}

speed_t termios_speed(uint32_t baud) {
  switch (baud) {
    case 115200:
      return B115200;
    case 500000:
      return B500000;
    case 1000000:
      return B1000000;
    default:
      throw std::invalid_argument("no such speed of a terminal");
  }
}

}  // namespace

Terminal::Terminal(SerialLine& line, std::string path, uint32_t baud)
    : line_(line), path_(std::move(path)), baud_(baud) {
  appear();
}

Terminal::~Terminal() { vanish(); }

void Terminal::appear() {
  if (master_ >= 0) return;
  master_ = posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  if (master_ < 0 || grantpt(master_) != 0 || unlockpt(master_) != 0) fail("pseudo terminal");
  termios settings;
  tcgetattr(master_, &settings);
  cfmakeraw(&settings);
  tcsetattr(master_, TCSANOW, &settings);
  // only a terminal that was closed once tells that nobody has it open
  const int slave = open(ptsname(master_), O_RDWR | O_NOCTTY | O_CLOEXEC);
  if (slave < 0) fail(ptsname(master_));
  close(slave);
  unlink(path_.c_str());
  if (symlink(ptsname(master_), path_.c_str()) != 0) fail(path_.c_str());
}

void Terminal::vanish() {
  if (master_ < 0) return;
  unlink(path_.c_str());
  close(master_);
  master_ = -1;
  is_open_ = false;
  leaving_.clear();
}

bool Terminal::exchange(uint64_t now) {
  if (!line_.is_plugged()) {
    vanish();
    return false;
  }
  appear();
  pollfd state = {master_, POLLIN, 0};
  poll(&state, 1, 0);
  const bool was_open = is_open_;
  is_open_ = !(state.revents & POLLHUP);
  if (state.revents & POLLIN) read_from_host(now);
  write_to_host(now);
  return is_open_ && !was_open;
}

bool Terminal::host_talks_at_our_speed() const {
  termios settings;
  tcgetattr(master_, &settings);
  return cfgetospeed(&settings) == termios_speed(baud_);
}

void Terminal::read_from_host(uint64_t now) {
  uint8_t bytes[1024];
  const ssize_t count = read(master_, bytes, sizeof bytes);
  if (count <= 0) return;
  if (!host_talks_at_our_speed()) {
    line_.note_wrong_baud(count);
    return;
  }
  for (ssize_t i = 0; i < count; ++i) line_.send_to_board(bytes[i], now);
}

void Terminal::write_to_host(uint64_t now) {
  while (const auto byte = line_.to_host().take(now)) leaving_.push_back(*byte);
  if (!is_open_) leaving_.clear();  // the bridge sends whether somebody listens or not
  while (!leaving_.empty()) {
    uint8_t bytes[1024];
    size_t count = 0;
    while (count < sizeof bytes && count < leaving_.size()) {
      bytes[count] = leaving_[count];
      ++count;
    }
    const ssize_t written = write(master_, bytes, count);
    if (written <= 0) return;
    leaving_.erase(leaving_.begin(), leaving_.begin() + written);
  }
}

}  // namespace rig
