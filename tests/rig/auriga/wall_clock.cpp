#include "wall_clock.hpp"

#include <time.h>

#include "mcu.hpp"

namespace rig {
namespace {

// Shorter than the firmware's patience with a silent host, which hears nothing meanwhile.
constexpr double kLargestLagS = 0.1;

double monotonic_s() {
  timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return now.tv_sec + now.tv_nsec * 1e-9;
}

}  // namespace

WallClock::WallClock() : origin_s_(monotonic_s()) {}

void WallClock::wait_for(uint64_t cycle) {
  const double ahead_s = time_s(cycle) - monotonic_s();
  if (ahead_s > 0) {
    const auto whole_s = static_cast<time_t>(ahead_s);
    const timespec pause = {whole_s, static_cast<long>((ahead_s - whole_s) * 1e9)};
    nanosleep(&pause, nullptr);
  } else if (-ahead_s > kLargestLagS) {
    origin_s_ += -ahead_s;
  }
}

double WallClock::time_s(uint64_t cycle) const {
  return origin_s_ + static_cast<double>(cycle) / kCpuHz;
}

}  // namespace rig
