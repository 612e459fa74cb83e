#include "rail.hpp"

#include <cmath>

namespace rig {

Rail::Rail(Mcu& mcu, Pin step, Pin direction, Pin switch_pin, const Power& power,
           const RailNumbers& numbers)
    : mcu_(mcu),
      power_(power),
      numbers_(numbers),
      switch_(mcu, switch_pin),
      position_(std::llround(numbers.start)) {
  mcu.watch(step, [this](bool high) { on_step(high); });
  mcu.watch(direction, [this](bool high) { on_direction(high); });
  move(0);
}

void Rail::forget_statistics() {
  steps_ = lost_ = 0;
  stepped_at_ = 0;
  shortest_pulse_ = shortest_set_up_ = shortest_interval_ = kNone;
}

void Rail::on_direction(bool high) {
  backwards_ = high;
  direction_at_ = mcu_.now();
}

void Rail::on_step(bool high) {
  const uint64_t now = mcu_.now();
  if (!high) {
    if (raised_at_ != 0) shortest_pulse_ = std::min(shortest_pulse_, now - raised_at_);
    return;
  }
  raised_at_ = now;
  if (direction_at_ != 0) shortest_set_up_ = std::min(shortest_set_up_, now - direction_at_);
  if (stepped_at_ != 0) shortest_interval_ = std::min(shortest_interval_, now - stepped_at_);
  stepped_at_ = now;
  ++steps_;
  move(backwards_ != numbers_.reversed ? -1 : 1);
}

void Rail::move(int way) {
  const int64_t next = position_ + way;
  if (way != 0 && (!power_.on() || next < numbers_.lowest || next > numbers_.highest)) {
    ++lost_;
    return;
  }
  position_ = next;
  switch_.press(position_ <= numbers_.switch_at);
  if (way != 0) on_moved_(position_);
}

}  // namespace rig
