// Consistent overhead byte stuffing: frames without zero bytes, with a zero behind each.
#pragma once
#include <stdint.h>

namespace plugpilot {

constexpr uint8_t kCobsDelimiter = 0;
constexpr uint8_t kCobsLongestRun = 254;  // bytes behind one code byte

// Takes a stream byte by byte and hands out the frames in it.
//
// Capacity: the largest decoded frame, at most 254 bytes. A longer or broken frame is dropped and
// counted; the next delimiter starts afresh.
template <uint8_t Capacity>
class CobsDecoder {
 public:
  // Returns the size of the frame that this byte has completed, else 0. The frame stays in
  // bytes() until the next call.
  uint8_t feed(uint8_t byte) {
    if (byte == kCobsDelimiter) return finish();
    if (run_left_ == 0) {
      // the zero that the code byte of the run before stands for, unless that run was full
      if (started_ && zero_follows_) put(0);
      run_left_ = static_cast<uint8_t>(byte - 1);
      zero_follows_ = run_left_ != kCobsLongestRun;
      started_ = true;
    } else {
      put(byte);
      --run_left_;
    }
    return 0;
  }

  const uint8_t* bytes() const { return bytes_; }
  uint16_t dropped() const { return dropped_; }

 private:
  uint8_t finish() {
    const bool good = started_ && run_left_ == 0 && !too_long_;
    const uint8_t size = good ? size_ : 0;
    if (started_ && !good) ++dropped_;
    started_ = too_long_ = zero_follows_ = false;
    run_left_ = size_ = 0;
    return size;
  }

  void put(uint8_t byte) {
    if (size_ < Capacity) {
      bytes_[size_++] = byte;
    } else {
      too_long_ = true;
    }
  }

  uint8_t bytes_[Capacity];
  uint8_t size_ = 0;
  uint8_t run_left_ = 0;
  bool started_ = false;
  bool zero_follows_ = false;
  bool too_long_ = false;
  uint16_t dropped_ = 0;
};

// Gives each byte of the encoded frame, the delimiter behind it included, to sink(byte).
template <class Sink>
void cobs_encode(const uint8_t* bytes, uint8_t size, Sink sink) {
  uint8_t start = 0;
  for (;;) {
    uint8_t end = start;
    while (end < size && bytes[end] != 0 && end - start < kCobsLongestRun) ++end;
    sink(static_cast<uint8_t>(end - start + 1));
    for (uint8_t i = start; i < end; ++i) sink(bytes[i]);
    if (end >= size) break;
    start = (end - start == kCobsLongestRun) ? end : static_cast<uint8_t>(end + 1);
  }
  sink(kCobsDelimiter);
}

}  // namespace plugpilot
