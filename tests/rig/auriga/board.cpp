#include "board.hpp"

namespace rig {
namespace {

RailNumbers rail_numbers(const Options& options, const std::string& axis) {
  return {options.number(axis + ".start"), options.number(axis + ".lowest"),
          options.number(axis + ".highest"), options.number(axis + ".switch_at"),
          options.number(axis + ".reversed") != 0};
}

SlideNumbers slide_numbers(const Options& options) {
  return {options.number("rho3.start_mm"),
          options.number("rho3.lowest_mm"),
          options.number("rho3.highest_mm"),
          options.number("rho3.switch_at_mm"),
          options.number("rho3.edges_per_mm"),
          options.number("rho3.force_per_pwm_n"),
          options.number("rho3.back_emf_pwm_s_per_mm"),
          options.number("rho3.friction_n"),
          options.number("rho3.time_constant_s")};
}

}  // namespace

Board::Board(const Options& options, double latency_s)
    : mcu(options.text("firmware")),
      line(latency_s),
      uart(mcu, line),
      power(mcu, Pin(DRIVE_RELAY_PORT, DRIVE_RELAY), Pin(SWITCH_PIN, STOP_CIRCUIT)),
      rho1(mcu, Pin(RHO1_STEP_PORT, RHO1_STEP), Pin(RHO1_DIR_PORT, RHO1_DIR),
           Pin(SWITCH_PIN, RHO1_SWITCH), power, rail_numbers(options, "rho1")),
      rho2(mcu, Pin(RHO2_STEP_PORT, RHO2_STEP), Pin(RHO2_DIR_PORT, RHO2_DIR),
           Pin(SWITCH_PIN, RHO2_SWITCH), power, rail_numbers(options, "rho2")),
      rho3(mcu, power, slide_numbers(options)),
      ticks(mcu),
      trace(mcu, ticks, rho1, rho2) {}

void Board::press_reset() {
  uart.flush();
  mcu.reset(Mcu::Reset::BUTTON);
}

void Board::cycle_power() {
  uart.flush();
  mcu.reset(Mcu::Reset::POWER_ON);
}

void Board::forget_statistics() {
  rho1.forget_statistics();
  rho2.forget_statistics();
  ticks.forget_statistics();
}

Switch* Board::limit_switch(int axis) {
  switch (axis) {
    case 0:
      return &rho1.limit_switch();
    case 1:
      return &rho2.limit_switch();
    case 2:
      return &rho3.limit_switch();
    default:
      return nullptr;
  }
}

}  // namespace rig
