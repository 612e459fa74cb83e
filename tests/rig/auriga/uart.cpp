#include "uart.hpp"

#include <simavr/sim_interrupts.h>

namespace rig {
namespace {

constexpr unsigned kHardwareBuffer = 2;
constexpr unsigned kSimulatedBufferMask = 63;

}  // namespace

Uart::Uart(Mcu& mcu, SerialLine& line) : mcu_(mcu), line_(line) {
  avr_t* avr = mcu.avr();
  input_ = avr_io_getirq(avr, AVR_IOCTL_UART_GETIRQ('0'), UART_IRQ_INPUT);
  avr_irq_register_notify(avr_io_getirq(avr, AVR_IOCTL_UART_GETIRQ('0'), UART_IRQ_OUTPUT), sent,
                          this);
  avr_irq_register_notify(mcu.uart0()->rxc.irq + AVR_INT_IRQ_RUNNING, fetched, this);
}

void Uart::kick() {
  mend_byte_time();
  if (byte_cycles_ == 0 || line_.to_board().empty()) return;
  if (avr_cycle_timer_status(mcu_.avr(), arrive, this) != 0) return;
  mcu_.after(byte_cycles_, arrive, this);
}

void Uart::flush() {
  line_.to_board().clear();
  avr_cycle_timer_cancel(mcu_.avr(), arrive, this);
}

void Uart::sent(avr_irq_t*, uint32_t value, void* parameter) {
  Uart& self = *static_cast<Uart*>(parameter);
  self.line_.send_to_host(static_cast<uint8_t>(value), self.mcu_.now());
}

// simavr raises the next interrupt only a byte's time after this one; the chip does so at once.
void Uart::fetched(avr_irq_t*, uint32_t value, void* parameter) {
  Uart& self = *static_cast<Uart*>(parameter);
  if (value == 0 && self.waiting() > 0) self.raise_received();
}

avr_cycle_count_t Uart::arrive(avr_t* avr, avr_cycle_count_t when, void* parameter) {
  Uart& self = *static_cast<Uart*>(parameter);
  const auto byte = self.line_.to_board().take(self.mcu_.now());
  if (byte) {
    if (self.waiting() < kHardwareBuffer) {
      avr_raise_irq(self.input_, *byte);
      self.raise_received();
    } else {
      ++self.overruns_;
      avr_regbit_set(avr, self.mcu_.uart0()->dor);
    }
  }
  return self.line_.to_board().empty() ? 0 : when + self.byte_cycles_;
}

// simavr counts a parity bit even where there is none: eleven bits instead of ten.
void Uart::mend_byte_time() {
  avr_uart_t* uart = mcu_.uart0();
  if (uart->cycles_per_byte == byte_cycles_) return;
  byte_cycles_ = uart->cycles_per_byte = uart->cycles_per_byte * 10 / 11;
}

void Uart::raise_received() {
  avr_uart_t* uart = mcu_.uart0();
  uart->rx_cnt = 0;
  uart->rxc_raise_time = 0;
  avr_raise_interrupt(mcu_.avr(), &uart->rxc);
}

unsigned Uart::waiting() const {
  const uart_fifo_t& input = mcu_.uart0()->input;
  return (input.write - input.read) & kSimulatedBufferMask;
}

}  // namespace rig
