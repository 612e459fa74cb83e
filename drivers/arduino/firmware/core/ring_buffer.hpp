// Bytes between an interrupt and the main loop; one side writes, the other reads.
#pragma once
#include <stdint.h>

#include "critical_section.hpp"

namespace plugpilot {

// One place stays free to tell full from empty. Indices of 16 bits take two instructions to read,
// so the interrupts are locked out meanwhile.
//
// Capacity: a power of two.
template <uint16_t Capacity>
class RingBuffer {
 public:
  static_assert((Capacity & (Capacity - 1)) == 0, "indices wrap by a mask");

  bool empty() const {
    CriticalSection lock;
    return head_ == tail_;
  }

  uint16_t room() const {
    CriticalSection lock;
    return static_cast<uint16_t>(tail_ - head_ - 1) & kMask;
  }

  // False if there is no room; the byte is lost.
  inline __attribute__((always_inline)) bool put(uint8_t byte) {
    CriticalSection lock;
    const uint16_t next = static_cast<uint16_t>(head_ + 1) & kMask;
    if (next == tail_) return false;
    bytes_[head_] = byte;
    head_ = next;
    return true;
  }

  // Only if it is not empty.
  inline __attribute__((always_inline)) uint8_t take() {
    CriticalSection lock;
    const uint8_t byte = bytes_[tail_];
    tail_ = static_cast<uint16_t>(tail_ + 1) & kMask;
    return byte;
  }

 private:
  static constexpr uint16_t kMask = Capacity - 1;

  uint8_t bytes_[Capacity];
  volatile uint16_t head_ = 0;
  volatile uint16_t tail_ = 0;
};

using ReceiveBuffer = RingBuffer<1024>;  // two whole windows of the host
using SendBuffer = RingBuffer<256>;

}  // namespace plugpilot
