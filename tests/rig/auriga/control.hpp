// The control channel: a Unix socket with one client, a command a line, a JSON answer a line.
#pragma once
#include <functional>
#include <string>

namespace rig {

class Control {
 public:
  // Args: path of the socket; what answers a line, throwing std::invalid_argument for a bad one.
  // Throws std::system_error.
  Control(std::string path, std::function<std::string(const std::string&)> answer);
  ~Control();

  Control(const Control&) = delete;
  Control& operator=(const Control&) = delete;

  // Answer what has come in. An answer {"error": ...} tells what was wrong with a line.
  void exchange();

  // Tell the client something it has not asked for; without a client nobody hears it.
  void tell(const std::string& line);

 private:
  void look_for_client();
  void hang_up();

  std::string path_;
  std::function<std::string(const std::string&)> answer_;
  int listener_ = -1;
  int client_ = -1;
  std::string received_;
};

}  // namespace rig
