// The whole board with a slide behind it, for tests of its gains on the host's side of the link.
//
// Input, a line each: the payloads of the configuration in the order of its CRC, as one hexadecimal
// number; counts per mm, friction [N], force per PWM [N], back EMF [PWM s/mm], time constant [s],
// place and size of the load [mm, N]; the milliseconds to go on at rest; then the payloads of
// segments. The board is homed before. Output: a line a millisecond, `state fault set_point measured
// true pwm force_dn`, places in counts.
#include <cstdlib>
#include <cstring>
#include <iostream>
#include <string>
#include <vector>

#include "../core/board.hpp"
#include "screw.hpp"

using namespace plugpilot;

namespace {

constexpr double kTickS = 1.0 / protocol::TICK_HZ;

template <class Value>
Value read_hex() {
  std::string text;
  Value value = {};
  std::cin >> text;
  if (text.size() != 2 * sizeof value) {
    std::cerr << text.size() / 2 << " bytes came instead of " << sizeof value << "\n";
    std::exit(1);
  }
  for (size_t i = 0; i < sizeof value; ++i) {
    reinterpret_cast<uint8_t*>(&value)[i] = std::stoi(text.substr(2 * i, 2), nullptr, 16);
  }
  return value;
}

class Machine {
 public:
  Machine(const Configuration& config, double counts_per_mm, const screw::Numbers& numbers)
      : counts_per_mm_(counts_per_mm),
        start_(config.homing.rest_position[kSlide]),
        screw_(numbers, config.homing.rest_position[kSlide] / counts_per_mm) {
    for (uint8_t axis = 0; axis < kAxes; ++axis) {
      place_[axis] = config.homing.rest_position[axis];
      switch_at_[axis] = config.axis[axis].switch_position;
    }
    board.configure(config);
    board.enable();
    board.home();
    while (board.state() == protocol::State::HOMING) millisecond();
  }

  void millisecond() {
    Inputs inputs = {};
    for (int tick = 0; tick < kTicksPerMillisecond; ++tick) {
      const uint8_t pins = board.interpolator().tick(0);
      for (uint8_t axis = 0; axis < kRails; ++axis) {
        if (pins & 1 << axis) place_[axis] += pins & 1 << (axis + kBackwardsShift) ? -1 : 1;
      }
      screw_.step(outputs_.drives_on ? outputs_.pwm : 0, kTickS);
    }
    place_[kSlide] = std::floor(slide_counts());
    for (uint8_t axis = 0; axis < kAxes; ++axis) {
      if (place_[axis] <= switch_at_[axis]) inputs.switch_levels |= 1 << axis;
    }
    inputs.encoder_raw = static_cast<int32_t>(place_[kSlide]) - start_;
    board.hear_host();
    outputs_ = board.every_millisecond(inputs);
  }

  double slide_counts() const { return screw_.position_mm() * counts_per_mm_; }

  Board board;

 private:
  double counts_per_mm_;
  int32_t start_;
  screw::Screw screw_;
  double place_[kAxes];
  double switch_at_[kAxes];
  Outputs outputs_ = {};
};

void print(const Machine& machine) {
  protocol::Telemetry now = {};
  machine.board.report(now);
  std::cout << int(now.state) << ' ' << int(now.fault) << ' ' << now.commanded[kSlide] << ' '
            << now.measured_rho3 << ' ' << machine.slide_counts() << ' ' << now.pwm << ' '
            << now.force_dn << '\n';
}

}  // namespace

int main() {
  const Configuration config = read_hex<Configuration>();
  double counts_per_mm;
  screw::Numbers numbers;
  int rest_ms;
  std::cin >> counts_per_mm >> numbers.friction_n >> numbers.force_per_pwm_n >>
      numbers.back_emf_pwm_s_per_mm >> numbers.time_constant_s >> numbers.load_from_mm >>
      numbers.load_n >> rest_ms;
  Machine machine(config, counts_per_mm, numbers);
  while (std::cin >> std::ws && !std::cin.eof()) {
    const protocol::Segment segment = read_hex<protocol::Segment>();
    protocol::Refusal refusal;
    while ((refusal = machine.board.push(segment)) == protocol::Refusal::QUEUE_FULL) {
      machine.millisecond();
      print(machine);
    }
    if (refusal != protocol::Refusal::NONE) {
      std::cerr << "segment " << segment.number << " was refused: " << int(refusal) << "\n";
      return 1;
    }
  }
  for (int ms = 0; ms < rest_ms || machine.board.state() == protocol::State::RUN; ++ms) {
    machine.millisecond();
    print(machine);
  }
  return 0;
}
