#include "tick_watch.hpp"

#include <core/protocol.hpp>
#include <simavr/sim_io.h>

namespace rig {
namespace {

constexpr int kTimer2CompareA = 13;  // interrupt vector of the ATmega2560
constexpr uint16_t kOcr1al = 0x88;     // the closed loop writes it once a round
constexpr uint64_t kTickCycles = kCpuHz / plugpilot::protocol::TICK_HZ;

}  // namespace

TickWatch::TickWatch(Mcu& mcu) : mcu_(mcu) {
  mcu.watch_interrupt(kTimer2CompareA, [this](bool begins) { on_tick(begins); });
  avr_irq_t* pwm = avr_iomem_getirq(mcu.avr(), kOcr1al, nullptr, AVR_IOMEM_IRQ_ALL);
  avr_irq_register_notify(pwm, on_pwm, this);
  mcu.on_reset([this] { began_ = round_began_ = since_reset_ = 0; });
}

void TickWatch::forget_statistics() {
  since_ = mcu_.now();
  asleep_before_ = mcu_.asleep();
  began_ = in_tick_ = ticks_ = late_ = longest_interval_ = longest_run_ = 0;
  round_began_ = rounds_ = longest_round_ = 0;
  shortest_interval_ = ~uint64_t{0};
}

double TickWatch::tick_share() const {
  return static_cast<double>(in_tick_) / std::max<uint64_t>(mcu_.now() - since_, 1);
}

double TickWatch::awake_share() const {
  const double all = std::max<uint64_t>(mcu_.now() - since_, 1);
  return 1.0 - (mcu_.asleep() - asleep_before_) / all;
}

void TickWatch::on_pwm(avr_irq_t*, uint32_t, void* parameter) {
  TickWatch& self = *static_cast<TickWatch*>(parameter);
  const uint64_t now = self.mcu_.now();
  if (self.round_began_ != 0) {
    self.longest_round_ = std::max(self.longest_round_, now - self.round_began_);
  }
  self.round_began_ = now;
  ++self.rounds_;
}

void TickWatch::on_tick(bool begins) {
  const uint64_t now = mcu_.now();
  if (!begins) {
    if (began_ == 0) return;
    in_tick_ += now - began_;
    longest_run_ = std::max(longest_run_, now - began_);
    return;
  }
  if (began_ != 0) {
    const uint64_t interval = now - began_;
    longest_interval_ = std::max(longest_interval_, interval);
    shortest_interval_ = std::min(shortest_interval_, interval);
    if (interval > kTickCycles * 3 / 2) ++late_;
  }
  began_ = now;
  ++ticks_;
  ++since_reset_;
}

}  // namespace rig
