// A Me Auriga with the real firmware, its motors and switches, and a pseudo terminal as its USB port.
//
// Options: firmware=ELF pty=PATH control=PATH speed=FACTOR sample_s=PERIOD, and the numbers of the
// axes as in board.cpp. Prints "ready" when both paths are there, and ends with its standard input.
#include <poll.h>
#include <unistd.h>

#include <cstdio>
#include <exception>

#include "board.hpp"
#include "commands.hpp"
#include "control.hpp"
#include "report.hpp"
#include "wall_clock.hpp"

namespace rig {
namespace {

constexpr uint64_t kSliceCycles = kCpuHz / 4000;  // bytes wait no longer than 250 us

// Whoever started this program holds the other end, so it cannot be left behind.
bool abandoned() {
  pollfd input = {STDIN_FILENO, POLLIN, 0};
  char byte;
  return poll(&input, 1, 0) > 0 && read(STDIN_FILENO, &byte, 1) <= 0;
}

void run(const Options& options) {
  Board board(options);
  WallClock clock(options.number("speed"));
  Control control(options.text("control"),
                  [&](const std::string& line) { return obey(line, board, clock); });
  const auto sample_cycles = static_cast<uint64_t>(options.number("sample_s") * kCpuHz);
  uint64_t next_sample = 0;
  printf("ready\n");
  fflush(stdout);
  while (!abandoned()) {
    board.mcu.run_until(board.mcu.now() + kSliceCycles);
    if (board.line.exchange(board.mcu.now())) board.press_reset();
    board.uart.kick();
    if (board.mcu.now() >= next_sample) {
      next_sample = board.mcu.now() + sample_cycles;
      control.tell("{\"sample\":" + state_json(board, clock) + "}");
    }
    control.exchange();
    clock.wait_for(board.mcu.now());
  }
}

}  // namespace
}  // namespace rig

int main(int count, char** arguments) {
  try {
    rig::run(rig::Options(count, arguments));
  } catch (const std::exception& error) {
    fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
