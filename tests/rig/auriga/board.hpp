// Everything that is soldered and screwed together: the microcontroller and what hangs on its pins.
#pragma once
#include "mcu.hpp"
#include "options.hpp"
#include "power.hpp"
#include "rail.hpp"
#include "serial_line.hpp"
#include "slide.hpp"
#include "step_trace.hpp"
#include "tick_watch.hpp"
#include "uart.hpp"

namespace rig {

struct Board {
  // The latency is that of a byte on the cable.
  Board(const Options& options, double latency_s);

  // The button on the board, or the bridge's DTR.
  void press_reset();

  // Off and on again.
  void cycle_power();

  void forget_statistics();

  // Null for a number that is no axis.
  Switch* limit_switch(int axis);

  Mcu mcu;
  SerialLine line;
  Uart uart;
  Power power;
  Rail rho1;
  Rail rho2;
  Slide rho3;
  TickWatch ticks;
  StepTrace trace;
};

}  // namespace rig
