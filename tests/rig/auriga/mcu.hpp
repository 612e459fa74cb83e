// The microcontroller: an ATmega2560 in simavr that runs the real firmware.
//
// It hides what simavr does differently from the chip. Time is counted in clock cycles from the
// start of the program and goes on over resets.
#pragma once
#include <simavr/avr_uart.h>
#include <simavr/sim_avr.h>

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "pin.hpp"

namespace rig {

constexpr uint64_t kCpuHz = 16'000'000;

class Mcu {
 public:
  enum class Reset { POWER_ON, BUTTON };

  // Throws std::runtime_error if the firmware cannot be read.
  explicit Mcu(const std::string& elf);

  Mcu(const Mcu&) = delete;
  Mcu& operator=(const Mcu&) = delete;

  // Run to this time or an instruction further, or until interrupt().
  // Throws std::runtime_error if the firmware has crashed.
  void run_until(uint64_t cycle);

  // Let run_until() return after the instruction that is being executed.
  void interrupt() { interrupted_ = true; }

  uint64_t now() const { return before_reset_ + avr_->cycle; }
  uint64_t asleep() const { return asleep_; }
  unsigned resets() const { return resets_; }

  // From outside. Power-on also wipes the memory; the EEPROM stays.
  void reset(Reset kind);

  // Flip bits of a byte in the EEPROM; false if there is no such address.
  bool flip_eeprom(unsigned address, uint8_t mask);

  // Let the main loop run in a circle for ever; interrupts go on.
  void hang();

  // What shall happen after every reset, the watchdog's included.
  void on_reset(std::function<void()> action) { on_reset_.push_back(std::move(action)); }

  // Call again and again, every so many cycles; resets do not matter.
  void every(uint64_t cycles, std::function<void()> action);

  // Call once after so many cycles. A reset forgets it.
  void after(uint64_t cycles, avr_cycle_timer_t callback, void* parameter);

  // Call with the level of an output whenever it changes; a reset makes it low.
  void watch(Pin pin, std::function<void(bool)> action);

  // Set the level of an input from outside, whatever pull-up there is.
  void drive(Pin pin, bool level);

  // Call when an interrupt routine begins (true) and when it ends.
  void watch_interrupt(int vector, std::function<void(bool)> action);

  uint8_t data(uint16_t address) const { return avr_->data[address]; }
  avr_t* avr() { return avr_; }
  avr_uart_t* uart0() { return uart0_; }

 private:
  struct Repeated {
    Mcu* mcu;
    uint64_t cycles;
    std::function<void()> action;
  };
  struct Forced {
    uint8_t mask;
    uint8_t levels;
  };

  static void sleep_without_waiting(avr_t* avr, avr_cycle_count_t cycles);
  static void note_reset(avr_t* avr);
  static avr_cycle_count_t repeat(avr_t* avr, avr_cycle_count_t when, void* parameter);
  static avr_cycle_count_t wake_up(avr_t* avr, avr_cycle_count_t when, void* parameter);
  static void changed(avr_irq_t* irq, uint32_t value, void* parameter);

  void show(Pin pin);
  void mend_after_reset();
  void set_reset_flag(avr_regbit_t flag);
  avr_uart_t* find_uart0();

  avr_t* avr_;
  avr_uart_t* uart0_ = nullptr;
  uint64_t before_reset_ = 0;  // to be added to simavr's counter
  uint64_t reset_at_ = 0;
  uint64_t asleep_ = 0;
  unsigned resets_ = 0;
  bool has_reset_ = false;
  bool interrupted_ = false;
  void (*inner_reset_)(avr_t*) = nullptr;
  std::vector<std::unique_ptr<Repeated>> repeated_;
  std::vector<std::unique_ptr<std::function<void(bool)>>> watchers_;
  std::vector<avr_irq_t*> outputs_;
  std::vector<std::function<void()>> on_reset_;
  std::array<Forced, 26> forced_ = {};
};

}  // namespace rig
