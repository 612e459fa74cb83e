#include "step_trace.hpp"

namespace rig {

StepTrace::StepTrace(const Mcu& mcu, const TickWatch& ticks, Rail& rho1, Rail& rho2) {
  const auto keep = [this, &mcu, &ticks](int axis) {
    return [this, &mcu, &ticks, axis](int64_t position) {
      if (on_) steps_[axis].push_back({mcu.now(), ticks.since_reset(), position});
    };
  };
  rho1.on_moved(keep(0));
  rho2.on_moved(keep(1));
}

void StepTrace::record(bool on) {
  on_ = on;
  if (!on) return;
  for (auto& steps : steps_) steps.clear();
}

}  // namespace rig
