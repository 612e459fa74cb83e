// UART0 as the chip has it: a byte takes ten bits, and the third one that nobody fetches is lost.
#pragma once
#include "mcu.hpp"
#include "serial_line.hpp"

namespace rig {

class Uart {
 public:
  Uart(Mcu& mcu, SerialLine& line);

  // Begin to receive if bytes wait. Call it after the line has moved bytes.
  void kick();

  // Forget what is on the wire, as a reset of the bridge does.
  void flush();

  uint64_t overruns() const { return overruns_; }

 private:
  static void sent(avr_irq_t* irq, uint32_t value, void* parameter);
  static void fetched(avr_irq_t* irq, uint32_t value, void* parameter);
  static avr_cycle_count_t arrive(avr_t* avr, avr_cycle_count_t when, void* parameter);

  void mend_byte_time();
  void raise_received();
  unsigned waiting() const;

  Mcu& mcu_;
  SerialLine& line_;
  avr_irq_t* input_;
  avr_cycle_count_t byte_cycles_ = 0;
  uint64_t overruns_ = 0;
};

}  // namespace rig
