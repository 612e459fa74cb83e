#include "wall_clock.hpp"

#include <time.h>

#include <algorithm>

#include "mcu.hpp"

namespace rig {
namespace {

constexpr double kLargestLagS = 0.02;

double monotonic_s() {
  timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return now.tv_sec + now.tv_nsec * 1e-9;
}

}  // namespace

WallClock::WallClock(double speed)
    : speed_(speed), origin_s_(monotonic_s()), began_s_(origin_s_) {}

void WallClock::wait_for(uint64_t cycle) {
  const double ahead_s = due_s(cycle) - monotonic_s();
  if (ahead_s > 0) {
    const auto whole_s = static_cast<time_t>(ahead_s);
    const timespec pause = {whole_s, static_cast<long>((ahead_s - whole_s) * 1e9)};
    nanosleep(&pause, nullptr);
    slept_s_ += ahead_s;
    return;
  }
  worst_lag_s_ = std::max(worst_lag_s_, -ahead_s);
  if (-ahead_s > kLargestLagS) origin_s_ += -ahead_s;
}

double WallClock::due_s(uint64_t cycle) const {
  return origin_s_ + static_cast<double>(cycle) / (kCpuHz * speed_);
}

double WallClock::elapsed_s() const { return monotonic_s() - began_s_; }

void WallClock::forget_statistics() {
  began_s_ = monotonic_s();
  worst_lag_s_ = slept_s_ = 0;
}

}  // namespace rig
