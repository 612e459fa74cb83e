#include "control.hpp"

#include <errno.h>
#include <poll.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <stdexcept>
#include <system_error>

#include "report.hpp"

namespace rig {
namespace {

[[noreturn]] void fail(const char* what) {
  throw std::system_error(errno, std::generic_category(), what);
}

}  // namespace

Control::Control(std::string path, std::function<std::string(const std::string&)> answer)
    : path_(std::move(path)), answer_(std::move(answer)) {
  sockaddr_un address = {};
  address.sun_family = AF_UNIX;
  if (path_.size() >= sizeof address.sun_path) throw std::invalid_argument("path too long");
  memcpy(address.sun_path, path_.c_str(), path_.size());
  unlink(path_.c_str());
  listener_ = socket(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  if (listener_ < 0) fail("socket");
  if (bind(listener_, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0) fail("bind");
  if (listen(listener_, 1) != 0) fail("listen");
}

Control::~Control() {
  hang_up();
  close(listener_);
  unlink(path_.c_str());
}

void Control::look_for_client() {
  client_ = accept4(listener_, nullptr, nullptr, SOCK_CLOEXEC);
}

void Control::hang_up() {
  if (client_ >= 0) close(client_);
  client_ = -1;
  received_.clear();
}

void Control::exchange() {
  if (client_ < 0) look_for_client();
  if (client_ < 0) return;
  char bytes[4096];
  const ssize_t count = recv(client_, bytes, sizeof bytes, MSG_DONTWAIT);
  if (count == 0 || (count < 0 && errno != EAGAIN)) hang_up();
  if (count <= 0) return;
  received_.append(bytes, count);
  for (size_t end; (end = received_.find('\n')) != std::string::npos;) {
    const std::string line = received_.substr(0, end);
    received_.erase(0, end + 1);
    try {
      tell(answer_(line));
    } catch (const std::invalid_argument& error) {
      tell(error_json(error.what()));
    }
  }
}

// The client reads all the time, so a full socket means that it hangs: then waiting is right.
void Control::tell(const std::string& line) {
  if (client_ < 0) return;
  const std::string whole = line + "\n";
  if (send(client_, whole.data(), whole.size(), MSG_NOSIGNAL) < 0) hang_up();
}

}  // namespace rig
