// How punctual the firmware's tick and its closed loop are, and how busy the CPU.
#pragma once
#include <algorithm>
#include <cstdint>

#include "mcu.hpp"

namespace rig {

class TickWatch {
 public:
  explicit TickWatch(Mcu& mcu);

  void forget_statistics();

  uint64_t ticks() const { return ticks_; }
  uint64_t since_reset() const { return since_reset_; }  // ticks; never forgotten
  uint64_t late_ticks() const { return late_; }  // began more than half a tick after its time
  uint64_t longest_interval() const { return longest_interval_; }  // cycles
  uint64_t shortest_interval() const { return ticks_ > 1 ? shortest_interval_ : 0; }
  uint64_t longest_run() const { return longest_run_; }  // cycles
  uint64_t rounds() const { return rounds_; }  // of the closed loop
  uint64_t longest_round() const { return longest_round_; }  // cycles
  double tick_share() const;   // of the CPU, in the tick's interrupt
  double awake_share() const;  // of the CPU, not asleep

 private:
  static void on_pwm(avr_irq_t* irq, uint32_t value, void* parameter);
  void on_tick(bool begins);

  Mcu& mcu_;
  uint64_t since_ = 0;
  uint64_t asleep_before_ = 0;
  uint64_t began_ = 0;
  uint64_t in_tick_ = 0;
  uint64_t ticks_ = 0;
  uint64_t since_reset_ = 0;
  uint64_t late_ = 0;
  uint64_t longest_interval_ = 0;
  uint64_t shortest_interval_ = ~uint64_t{0};
  uint64_t longest_run_ = 0;
  uint64_t round_began_ = 0;
  uint64_t rounds_ = 0;
  uint64_t longest_round_ = 0;
};

}  // namespace rig
