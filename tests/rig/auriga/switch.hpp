// A normally closed switch to ground: pressed, or with its wire cut, the pull-up shows.
#pragma once
#include "mcu.hpp"

namespace rig {

class Switch {
 public:
  Switch(Mcu& mcu, Pin pin) : mcu_(mcu), pin_(pin) { show(); }

  bool pressed() const { return pressed_; }
  bool open() const { return pressed_ || cut_; }

  void press(bool pressed) {
    if (pressed == pressed_) return;
    pressed_ = pressed;
    show();
  }

  void cut(bool is_cut) {
    cut_ = is_cut;
    show();
  }

 private:
  void show() { mcu_.drive(pin_, open()); }

  Mcu& mcu_;
  Pin pin_;
  bool pressed_ = false;
  bool cut_ = false;
};

}  // namespace rig
