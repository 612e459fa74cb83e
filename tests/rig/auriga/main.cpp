// A Me Auriga with the real firmware, its motors and switches.
//
// Options: firmware=ELF sample_s=PERIOD, the numbers of the axes as in board.cpp, and
//
//   clock=wall pty=PATH control=PATH   in real time: a pseudo terminal as its USB port, and a socket
//                                      for everything else
//   clock=host began_s=TIME latency_s=DELAY
//                                      time passes when the host lets it: see lock_step.hpp
//
// Prints "ready" when it can be used, and ends with its standard input.
#include <poll.h>
#include <unistd.h>

#include <core/protocol.hpp>
#include <cstdio>
#include <exception>
#include <stdexcept>

#include "board.hpp"
#include "commands.hpp"
#include "control.hpp"
#include "lock_step.hpp"
#include "report.hpp"
#include "terminal.hpp"
#include "wall_clock.hpp"

namespace rig {
namespace {

constexpr uint64_t kSliceCycles = kCpuHz / 4000;  // bytes wait no longer than 250 us
constexpr double kNoLatency = 0;                  // the pseudo terminal has enough of it

// Whoever started this program holds the other end, so it cannot be left behind.
bool abandoned() {
  pollfd input = {STDIN_FILENO, POLLIN, 0};
  char byte;
  return poll(&input, 1, 0) > 0 && read(STDIN_FILENO, &byte, 1) <= 0;
}

void run_in_real_time(const Options& options) {
  Board board(options, kNoLatency);
  Terminal terminal(board.line, options.text("pty"), plugpilot::protocol::BAUD);
  WallClock clock;
  Control control(options.text("control"),
                  [&](const std::string& line) { return obey(line, board, clock); });
  const auto sample_cycles = static_cast<uint64_t>(options.number("sample_s") * kCpuHz);
  uint64_t next_sample = 0;
  printf("ready\n");
  fflush(stdout);
  while (!abandoned()) {
    board.mcu.run_until(board.mcu.now() + kSliceCycles);
    if (terminal.exchange(board.mcu.now())) board.press_reset();
    board.uart.kick();
    if (board.mcu.now() >= next_sample) {
      next_sample = board.mcu.now() + sample_cycles;
      control.tell("{\"sample\":" + state_json(board, clock) + "}");
    }
    control.exchange();
    clock.wait_for(board.mcu.now());
  }
}

void run_in_lock_step(const Options& options) {
  Board board(options, options.number("latency_s"));
  LockStep(board, options.number("began_s"), options.number("sample_s")).serve();
}

void run(const Options& options) {
  const std::string clock = options.text("clock");
  if (clock == "wall") return run_in_real_time(options);
  if (clock == "host") return run_in_lock_step(options);
  throw std::invalid_argument("clock is wall or host, not " + clock);
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
