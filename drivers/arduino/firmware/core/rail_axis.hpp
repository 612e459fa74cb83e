// One stepper axis: the phase accumulator that decides at which ticks a step is due.
#pragma once
#include <stdint.h>

namespace plugpilot {

// The position is a fixed-point number P: whole steps in `position` and 2^-31 steps in `phase`,
// which stays below 2^31. Each tick P += rate, then rate += acceleration. Both are signed, so a
// change of direction within a segment is as exact as everything else.
struct RailAxis {
  uint32_t phase;
  int32_t rate;
  int32_t acceleration;
  int32_t position;
};

constexpr uint8_t kTopBit = 0x80;

// What one tick has done, each in the top bit: whether P has passed a whole step, and whether
// backwards.
struct RailTick {
  uint8_t step;
  uint8_t backwards;
};

#ifdef __AVR__

// The same as below with fewer registers to save: written for the step interrupt, in which every
// cycle counts 20 000 times a second. The rig compares its steps with the host's prediction.
inline __attribute__((always_inline)) RailTick advance_by_one_tick(RailAxis& axis) {
  static_assert(sizeof(RailAxis) == 16, "the offsets below are those of its members");
  RailTick done;
  uint32_t rate;
  uint8_t byte;
  asm volatile(
      "ldd %A[rate], %a[axis]+4   \n ldd %B[rate], %a[axis]+5   \n"
      "ldd %C[rate], %a[axis]+6   \n ldd %D[rate], %a[axis]+7   \n"
      "mov %[backwards], %D[rate] \n"
      // phase += rate; its top bit is the step
      "ld %[byte], %a[axis]       \n add %[byte], %A[rate] \n st %a[axis], %[byte]    \n"
      "ldd %[byte], %a[axis]+1    \n adc %[byte], %B[rate] \n std %a[axis]+1, %[byte] \n"
      "ldd %[byte], %a[axis]+2    \n adc %[byte], %C[rate] \n std %a[axis]+2, %[byte] \n"
      "ldd %[byte], %a[axis]+3    \n adc %[byte], %D[rate] \n mov %[step], %[byte]    \n"
      "andi %[byte], 0x7F         \n std %a[axis]+3, %[byte] \n"
      // rate += acceleration
      "ldd %[byte], %a[axis]+8    \n add %A[rate], %[byte] \n std %a[axis]+4, %A[rate] \n"
      "ldd %[byte], %a[axis]+9    \n adc %B[rate], %[byte] \n std %a[axis]+5, %B[rate] \n"
      "ldd %[byte], %a[axis]+10   \n adc %C[rate], %[byte] \n std %a[axis]+6, %C[rate] \n"
      "ldd %[byte], %a[axis]+11   \n adc %D[rate], %[byte] \n std %a[axis]+7, %D[rate] \n"
      // position += 1 or -= 1, byte by byte as long as it carries
      "sbrs %[step], 7            \n rjmp 2f \n"
      "sbrc %[backwards], 7       \n rjmp 1f \n"
      "ldd %[byte], %a[axis]+12   \n inc %[byte] \n std %a[axis]+12, %[byte] \n brne 2f \n"
      "ldd %[byte], %a[axis]+13   \n inc %[byte] \n std %a[axis]+13, %[byte] \n brne 2f \n"
      "ldd %[byte], %a[axis]+14   \n inc %[byte] \n std %a[axis]+14, %[byte] \n brne 2f \n"
      "ldd %[byte], %a[axis]+15   \n inc %[byte] \n std %a[axis]+15, %[byte] \n rjmp 2f \n"
      "1: \n"
      "ldd %[byte], %a[axis]+12   \n subi %[byte], 1 \n std %a[axis]+12, %[byte] \n brcc 2f \n"
      "ldd %[byte], %a[axis]+13   \n subi %[byte], 1 \n std %a[axis]+13, %[byte] \n brcc 2f \n"
      "ldd %[byte], %a[axis]+14   \n subi %[byte], 1 \n std %a[axis]+14, %[byte] \n brcc 2f \n"
      "ldd %[byte], %a[axis]+15   \n subi %[byte], 1 \n std %a[axis]+15, %[byte] \n"
      "2: \n"
      : [step] "=&r"(done.step), [backwards] "=&r"(done.backwards), [rate] "=&r"(rate),
        [byte] "=&d"(byte)
      : [axis] "b"(&axis)
      : "memory");
  return done;
}

#else

// With |rate| < 2^31 the sum leaves [0, 2^31) by less than its width on either side. Both ways its
// highest bit is set, and clearing that bit brings the phase back into its range.
inline RailTick advance_by_one_tick(RailAxis& axis) {
  constexpr uint32_t overflow = UINT32_C(1) << 31;
  const uint32_t rate = static_cast<uint32_t>(axis.rate);
  const uint32_t sum = axis.phase + rate;
  axis.rate = static_cast<int32_t>(rate + static_cast<uint32_t>(axis.acceleration));
  axis.phase = sum & ~overflow;
  const bool step = sum & overflow;
  const bool backwards = rate & overflow;
  if (step) axis.position += backwards ? -1 : 1;
  return RailTick{static_cast<uint8_t>(step ? kTopBit : 0),
                  static_cast<uint8_t>(backwards ? kTopBit : 0)};
}

#endif

}  // namespace plugpilot
