// A stretch of the main loop that the step interrupt must not interrupt.
#pragma once

#ifdef __AVR__
#include <avr/interrupt.h>
#include <avr/io.h>
#endif

namespace plugpilot {

// Keep it short: the step interrupt waits meanwhile. On the host there is only one thread.
class CriticalSection {
 public:
#ifdef __AVR__
  CriticalSection() : status_(SREG) { cli(); }
  ~CriticalSection() { SREG = status_; }

 private:
  const uint8_t status_;
#else
  CriticalSection() {}
  ~CriticalSection() {}

 private:
#endif
  CriticalSection(const CriticalSection&) = delete;
  CriticalSection& operator=(const CriticalSection&) = delete;
};

}  // namespace plugpilot
