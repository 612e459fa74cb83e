// Bytes between an interrupt and the main loop; one side writes, the other reads.
#pragma once
#include <stdint.h>

namespace plugpilot {

// 256 places, so that the indices wrap by themselves; one place stays free to tell full from empty.
class RingBuffer {
 public:
  bool empty() const { return head_ == tail_; }
  uint8_t room() const { return static_cast<uint8_t>(tail_ - head_ - 1); }

  // False if there is no room; the byte is lost.
  inline __attribute__((always_inline)) bool put(uint8_t byte) {
    const uint8_t next = static_cast<uint8_t>(head_ + 1);
    if (next == tail_) return false;
    bytes_[head_] = byte;
    head_ = next;
    return true;
  }

  // Only if it is not empty.
  inline __attribute__((always_inline)) uint8_t take() {
    const uint8_t byte = bytes_[tail_];
    tail_ = static_cast<uint8_t>(tail_ + 1);
    return byte;
  }

 private:
  volatile uint8_t bytes_[256];
  volatile uint8_t head_ = 0;
  volatile uint8_t tail_ = 0;
};

}  // namespace plugpilot
