#include "mcu.hpp"

#include <simavr/avr_eeprom.h>
#include <simavr/avr_extint.h>
#include <simavr/avr_ioport.h>
#include <simavr/sim_elf.h>
#include <simavr/sim_interrupts.h>

#include <cstdarg>
#include <cstdio>
#include <cstring>
#include <stdexcept>

namespace rig {
namespace {

constexpr uint32_t kSupplyMv = 5000;
constexpr int kExternalInterrupts = 8;
constexpr uint16_t kJumpToItself = 0xCFFF;
constexpr uint16_t kMemoryStart = 0x200;  // registers are below

// simavr's callbacks know the avr_t only.
Mcu* the_mcu = nullptr;

// simavr's own would mix its words into the answers on standard output.
void log_to_standard_error(avr_t*, const int level, const char* format, va_list words) {
  if (level <= LOG_ERROR) vfprintf(stderr, format, words);
}

avr_t* make_mcu() {
  avr_global_logger_set(log_to_standard_error);
  return avr_make_mcu_by_name("atmega2560");
}

}  // namespace

Mcu::Mcu(const std::string& elf) : avr_(make_mcu()) {
  the_mcu = this;
  elf_firmware_t firmware = {};
  if (elf_read_firmware(elf.c_str(), &firmware) != 0) {
    throw std::runtime_error("cannot read the firmware " + elf);
  }
  avr_init(avr_);
  avr_->frequency = kCpuHz;
  avr_->vcc = avr_->avcc = avr_->aref = kSupplyMv;
  avr_load_firmware(avr_, &firmware);
  avr_->sleep = sleep_without_waiting;
  inner_reset_ = avr_->reset;
  avr_->reset = note_reset;
  uart0_ = find_uart0();
  set_reset_flag(avr_->reset_flags.porf);
  mend_after_reset();
}

void Mcu::run_until(uint64_t cycle) {
  interrupted_ = false;
  if (now() >= cycle) return;
  after(cycle - now(), wake_up, this);  // a sleeping CPU jumps from timer to timer
  while (now() < cycle && !interrupted_) {
    const int state = avr_run(avr_);
    if (state == cpu_Done || state == cpu_Crashed) {
      throw std::runtime_error("the firmware has crashed");
    }
    if (has_reset_) mend_after_reset();
  }
  avr_cycle_timer_cancel(avr_, wake_up, this);
}

void Mcu::reset(Reset kind) {
  if (kind == Reset::POWER_ON) {
    memset(avr_->data + kMemoryStart, 0, avr_->ramend + 1 - kMemoryStart);
  }
  avr_reset(avr_);
  mend_after_reset();
  set_reset_flag(kind == Reset::POWER_ON ? avr_->reset_flags.porf : avr_->reset_flags.extrf);
}

bool Mcu::flip_eeprom(unsigned address, uint8_t mask) {
  if (address > avr_->e2end) return false;
  uint8_t byte = 0;
  avr_eeprom_desc_t place = {&byte, static_cast<uint16_t>(address), 1};
  avr_ioctl(avr_, AVR_IOCTL_EEPROM_GET, &place);
  byte ^= mask;
  avr_ioctl(avr_, AVR_IOCTL_EEPROM_SET, &place);
  return true;
}

void Mcu::hang() {
  const uint32_t last_word = avr_->flashend - 1;  // far behind the firmware
  avr_->flash[last_word] = kJumpToItself & 0xFF;
  avr_->flash[last_word + 1] = kJumpToItself >> 8;
  if (avr_->state == cpu_Sleeping) avr_->state = cpu_Running;
  avr_->pc = last_word;
}

void Mcu::every(uint64_t cycles, std::function<void()> action) {
  repeated_.push_back(std::make_unique<Repeated>(Repeated{this, cycles, std::move(action)}));
  after(cycles, repeat, repeated_.back().get());
}

void Mcu::after(uint64_t cycles, avr_cycle_timer_t callback, void* parameter) {
  avr_cycle_timer_register(avr_, cycles, callback, parameter);
}

void Mcu::watch(Pin pin, std::function<void(bool)> action) {
  watchers_.push_back(std::make_unique<std::function<void(bool)>>(std::move(action)));
  avr_irq_t* irq = avr_io_getirq(avr_, AVR_IOCTL_IOPORT_GETIRQ(pin.port), pin.bit);
  avr_irq_register_notify(irq, changed, watchers_.back().get());
  outputs_.push_back(irq);
}

void Mcu::drive(Pin pin, bool level) {
  Forced& port = forced_[pin.port - 'A'];
  const uint8_t mask = 1 << pin.bit;
  port.mask |= mask;
  port.levels = level ? port.levels | mask : port.levels & ~mask;
  show(pin);
}

void Mcu::show(Pin pin) {
  const Forced& port = forced_[pin.port - 'A'];
  const bool level = port.levels & 1 << pin.bit;
  // without this every write to the port lets simavr raise the pulled-up inputs again
  avr_ioport_external_t external = {};
  external.name = pin.port;
  external.mask = port.mask;
  external.value = port.levels;
  avr_ioctl(avr_, AVR_IOCTL_IOPORT_SET_EXTERNAL(pin.port), &external);
  avr_raise_irq(avr_io_getirq(avr_, AVR_IOCTL_IOPORT_GETIRQ(pin.port), pin.bit), level);
}

void Mcu::watch_interrupt(int vector, std::function<void(bool)> action) {
  watchers_.push_back(std::make_unique<std::function<void(bool)>>(std::move(action)));
  avr_irq_t* irq = avr_get_interrupt_irq(avr_, vector) + AVR_INT_IRQ_RUNNING;
  avr_irq_register_notify(irq, changed, watchers_.back().get());
}

void Mcu::sleep_without_waiting(avr_t*, avr_cycle_count_t cycles) { the_mcu->asleep_ += cycles; }

// simavr calls this in the middle of its reset.
void Mcu::note_reset(avr_t* avr) {
  the_mcu->reset_at_ = the_mcu->now();
  the_mcu->has_reset_ = true;
  ++the_mcu->resets_;
  if (the_mcu->inner_reset_ != nullptr) the_mcu->inner_reset_(avr);
}

avr_cycle_count_t Mcu::repeat(avr_t*, avr_cycle_count_t when, void* parameter) {
  const Repeated& repeated = *static_cast<Repeated*>(parameter);
  repeated.action();
  return when + repeated.cycles;
}

avr_cycle_count_t Mcu::wake_up(avr_t*, avr_cycle_count_t, void*) { return 0; }

void Mcu::changed(avr_irq_t*, uint32_t value, void* parameter) {
  // outputs carry a mark in a higher bit; interrupts come with their number
  const bool on = (value & AVR_IOPORT_OUTPUT) ? value & 1 : value != 0;
  (*static_cast<std::function<void(bool)>*>(parameter))(on);
}

void Mcu::mend_after_reset() {
  has_reset_ = false;
  // versions of simavr differ in whether a reset sets their counter to 0
  before_reset_ = reset_at_ - avr_->cycle;
  // an INTn at level mode with its pin low would poll at every cycle
  for (int number = 0; number < kExternalInterrupts; ++number) {
    avr_extint_set_strict_lvl_trig(avr_, number, 0);
  }
  uint32_t flags = 0;
  avr_ioctl(avr_, AVR_IOCTL_UART_GET_FLAGS('0'), &flags);
  flags &= ~(AVR_UART_FLAG_STDIO | AVR_UART_FLAG_POLL_SLEEP);
  avr_ioctl(avr_, AVR_IOCTL_UART_SET_FLAGS('0'), &flags);
  for (avr_irq_t* output : outputs_) avr_raise_irq(output, 0);
  // simavr has forgotten what comes from outside, but would not be told the same level again
  for (size_t port = 0; port < forced_.size(); ++port) {
    for (int bit = 0; bit < 8; ++bit) {
      if (!(forced_[port].mask & 1 << bit)) continue;
      const Pin pin(static_cast<char>('A' + port), bit);
      avr_io_getirq(avr_, AVR_IOCTL_IOPORT_GETIRQ(pin.port), pin.bit)->flags |= IRQ_FLAG_INIT;
      show(pin);
    }
  }
  for (const auto& repeated : repeated_) after(repeated->cycles, repeat, repeated.get());
  for (const auto& action : on_reset_) action();
}

void Mcu::set_reset_flag(avr_regbit_t flag) { avr_regbit_set(avr_, flag); }

avr_uart_t* Mcu::find_uart0() {
  for (avr_io_t* io = avr_->io_port; io != nullptr; io = io->next) {
    if (strcmp(io->kind, "uart") != 0) continue;
    auto* uart = reinterpret_cast<avr_uart_t*>(io);
    if (uart->name == '0') return uart;
  }
  throw std::runtime_error("simavr's ATmega2560 has no UART0");
}

}  // namespace rig
