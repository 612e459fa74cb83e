#include "reset_record.hpp"

#include <avr/io.h>
#include <avr/wdt.h>

namespace plugpilot {
namespace reset_record {
namespace {

using protocol::Fault;
using protocol::ResetCause;

constexpr uint16_t kWritten = 0x5AFE;

// Memory that the start-up code leaves alone.
struct Record {
  uint16_t written;
  Fault fault;
  uint8_t complement;  // of the fault: memory that was never written matches by chance only
};

Record record __attribute__((section(".noinit")));
uint8_t reset_flags __attribute__((section(".noinit")));

}  // namespace

ResetCause cause() {
  if (reset_flags & _BV(WDRF)) return ResetCause::WATCHDOG;
  if (reset_flags & _BV(BORF)) return ResetCause::BROWN_OUT;
  if (reset_flags & _BV(PORF)) return ResetCause::POWER_ON;
  if (reset_flags & _BV(EXTRF)) return ResetCause::EXTERNAL;
  return ResetCause::UNKNOWN;
}

Fault fault_before() {
  const uint8_t code = static_cast<uint8_t>(record.fault);
  const bool whole = record.written == kWritten && static_cast<uint8_t>(~code) == record.complement;
  return whole ? record.fault : Fault::NONE;
}

void keep(Fault fault) {
  record.written = kWritten;
  record.fault = fault;
  record.complement = static_cast<uint8_t>(~static_cast<uint8_t>(fault));
}

// The watchdog stays on over a reset with its shortest time, so it is turned off before anything
// else; the flags must be cleared first.
extern "C" void note_reset_cause() __attribute__((naked, used, section(".init3")));
extern "C" void note_reset_cause() {
  reset_flags = MCUSR;
  MCUSR = 0;
  wdt_disable();
}

}  // namespace reset_record
}  // namespace plugpilot
