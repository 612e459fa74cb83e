#include "serial_line.hpp"

#include "mcu.hpp"

namespace rig {

std::optional<uint8_t> ByteQueue::take(uint64_t now) {
  if (bytes_.empty() || bytes_.front().due > now) return std::nullopt;
  const uint8_t byte = bytes_.front().byte;
  bytes_.pop_front();
  return byte;
}

std::optional<uint64_t> ByteQueue::next_due() const {
  if (bytes_.empty()) return std::nullopt;
  return bytes_.front().due;
}

void SerialLine::send_to_board(uint8_t byte, uint64_t now) {
  ++bytes_to_board_;
  carry(byte, now, to_board_);
}

void SerialLine::send_to_host(uint8_t byte, uint64_t now) {
  ++bytes_to_host_;
  carry(byte, now, to_host_);
  if (byte == 0) on_frame_sent_();
}

void SerialLine::unplug() {
  is_plugged_ = false;
  to_board_.clear();
  to_host_.clear();
}

void SerialLine::carry(uint8_t byte, uint64_t now, ByteQueue& queue) {
  if (!is_plugged_) return;
  if (is_cut_ || happens(faults_.lose)) {
    ++damage_.lost;
    return;
  }
  if (happens(faults_.flip)) {
    byte ^= 1 << (chance_() % 8);
    ++damage_.flipped;
  }
  if (faults_.delay_s > 0) ++damage_.delayed;
  const uint64_t due = now + static_cast<uint64_t>((latency_s_ + faults_.delay_s) * kCpuHz);
  queue.put(byte, due);
  if (happens(faults_.duplicate)) {
    queue.put(byte, due);
    ++damage_.duplicated;
  }
}

bool SerialLine::happens(double share) {
  return share > 0 && std::uniform_real_distribution<double>(0.0, 1.0)(chance_) < share;
}

}  // namespace rig
