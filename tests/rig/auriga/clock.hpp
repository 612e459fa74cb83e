// How the host counts simulated time.
#pragma once
#include <cstdint>

namespace rig {

class Clock {
 public:
  virtual ~Clock() = default;

  // When that cycle is, in seconds of the host's event loop.
  virtual double time_s(uint64_t cycle) const = 0;
};

}  // namespace rig
