// The motors' supply: through the relay that the firmware switches and, hard-wired, through the
// emergency-stop button.
#pragma once
#include "mcu.hpp"
#include "switch.hpp"

namespace rig {

class Power {
 public:
  Power(Mcu& mcu, Pin relay, Pin stop_circuit) : stop_circuit_(mcu, stop_circuit) {
    mcu.watch(relay, [this](bool high) { relay_ = high; });
  }

  bool on() const { return relay_ && !stop_circuit_.pressed(); }
  bool relay() const { return relay_; }
  Switch& stop_circuit() { return stop_circuit_; }

 private:
  Switch stop_circuit_;
  bool relay_ = false;
};

}  // namespace rig
