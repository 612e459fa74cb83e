// A normally closed switch to ground: pressed, or with its wire cut, the pull-up shows.
#pragma once
#include "mcu.hpp"

namespace rig {

class Switch {
 public:
  enum class Health { WHOLE, CUT, STUCK };  // stuck closed: pressing it shows nothing

  Switch(Mcu& mcu, Pin pin) : mcu_(mcu), pin_(pin) { show(); }

  bool pressed() const { return pressed_; }
  bool open() const {
    return health_ == Health::CUT || (pressed_ && health_ == Health::WHOLE);
  }

  void press(bool pressed) {
    if (pressed == pressed_) return;
    pressed_ = pressed;
    show();
  }

  void become(Health health) {
    health_ = health;
    show();
  }

 private:
  void show() { mcu_.drive(pin_, open()); }

  Mcu& mcu_;
  Pin pin_;
  bool pressed_ = false;
  Health health_ = Health::WHOLE;
};

}  // namespace rig
