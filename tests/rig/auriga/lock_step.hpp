// The host's clock: simulated time passes only while the host waits for it.
#pragma once
#include <cstdint>
#include <string>

#include "board.hpp"
#include "clock.hpp"

namespace rig {

class LockStep : public Clock {
 public:
  // Args: time of the host at cycle 0; period of the samples.
  LockStep(Board& board, double began_s, double sample_s);

  // Obey lines from standard input with a JSON line each on standard output, until it ends:
  //
  //   run CYCLE     let time pass until then, or until there is something for the host
  //   write HEX     bytes for the board
  //   open | close  the port; opening it resets the board, as DTR does
  //
  // and all of commands.hpp.
  void serve();

  double time_s(uint64_t cycle) const override;

 private:
  std::string answer(const std::string& line);
  std::string run(uint64_t until);
  void write(const std::string& hex);
  void open();
  uint64_t next_stop(uint64_t until);
  bool collect();

  Board& board_;
  double began_s_;
  uint64_t sample_cycles_;
  uint64_t next_sample_ = 0;
  bool is_open_ = false;
  std::string received_;  // hex
};

}  // namespace rig
