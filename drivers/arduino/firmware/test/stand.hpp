// A board on a test stand: pins that move carriages, a motor that moves the slide, switches.
#pragma once
#include "check.hpp"
#include <cmath>
#include <functional>

#include "../core/board.hpp"

namespace stand {

using namespace plugpilot;

constexpr double kPhase = 2147483648.0;  // 2^31

inline int32_t rate_of(double units_per_s) {
  return static_cast<int32_t>(units_per_s / protocol::TICK_HZ * kPhase);
}

inline int32_t acceleration_of(double units_per_s2) {
  return static_cast<int32_t>(units_per_s2 / protocol::TICK_HZ / protocol::TICK_HZ * kPhase);
}

// 100 steps and counts per millimetre; strokes of 100 and 50 mm.
inline Configuration configuration() {
  Configuration c = {};
  for (uint8_t i = 0; i < kAxes; ++i) {
    const bool slide = i == kSlide;
    protocol::ConfigAxis& axis = c.axis[i];
    axis.axis = i;
    axis.units_per_mm_q16 = 100 << 16;
    axis.travel_max = slide ? 5000 : 10000;
    axis.switch_position = -50;
    axis.max_rate = rate_of(slide ? 1400 : 9000);
    axis.max_rate_jump = rate_of(50);
    axis.stop_deceleration = acceleration_of(slide ? 40000 : 150000);
    axis.seek_rate = rate_of(slide ? 1000 : 6000);
    axis.locate_rate = rate_of(200);
    axis.homing_acceleration = acceleration_of(slide ? 10000 : 30000);
    axis.back_off = 300;
    axis.beyond_travel = 2000;
  }
  // the gains as in drivers/arduino/settings.py, for the motor below
  c.rho3 = {440, 300, 29000, 150, 6, 32640, 500, 900, 1500, 100, 300, 2, 10};
  c.homing = {8000, {4000, 4000, 100}};
  return c;
}

// The machine behind the pins, in its own true coordinates.
class Stand {
 public:
  explicit Stand(bool configured = true) {
    if (configured) board.configure(configuration());
    inputs.switch_levels = 0;
  }

  // True places of the axes; the switches open below -50.
  double place[kAxes] = {4000, 4000, 100};
  bool jammed = false;
  bool encoder_dead = false;
  double wall = 1e9;  // beyond it the slide presses a spring together
  uint8_t cut = 0;    // switches whose wires are cut
  uint8_t stuck = 0;  // switches that never open
  bool host_alive = true;
  Board board;
  Inputs inputs = {};
  Outputs outputs = {};

  void millisecond() {
    for (int tick = 0; tick < kTicksPerMillisecond; ++tick) step(board.interpolator().tick(levels()));
    move_slide();
    inputs.switch_levels = levels();
    inputs.tripped = board.interpolator().switches().take_tripped();
    if (!encoder_dead) {
      inputs.encoder_raw = static_cast<int32_t>(std::floor(place[kSlide] - kStart));
    }
    if (host_alive) board.hear_host();
    outputs = board.every_millisecond(inputs);
    board.interpolator().switches().watch(outputs.watched, outputs.released_levels);
  }

  void run(int milliseconds) {
    for (int i = 0; i < milliseconds; ++i) millisecond();
  }

  // Milliseconds until something is so, or -1.
  int run_until(const std::function<bool()>& done, int at_most_ms = 100000) {
    for (int i = 0; i < at_most_ms; ++i) {
      if (done()) return i;
      millisecond();
    }
    return -1;
  }

  bool in(protocol::State state) const { return board.state() == state; }

  protocol::Telemetry report() const {
    protocol::Telemetry telemetry = {};
    board.report(telemetry);
    return telemetry;
  }

  // Ready and homed.
  void home() {
    board.enable();
    board.home();
    run_until([this] { return !in(protocol::State::HOMING); });
  }

  // A segment behind the queue: constant acceleration for 20 ms.
  protocol::Segment segment(const int32_t (&rate)[kAxes], const int32_t (&acceleration)[kAxes]) {
    protocol::Segment message = {};
    message.number = report().next_segment;
    message.ticks = protocol::SEGMENT_TICKS;
    const QueueEnd& end = board.interpolator().end();
    for (uint8_t axis = 0; axis < kAxes; ++axis) {
      message.start[axis] = whole_part(end.position[axis]);
      message.phase[axis] = phase_part(end.position[axis]);
      message.rate[axis] = rate[axis];
      message.acceleration[axis] = acceleration[axis];
    }
    return message;
  }

  // Pushes a ramp from the end of the queue to other rates [units/s].
  protocol::Refusal ramp(double rho1, double rho2, double rho3) {
    const double to[kAxes] = {rho1, rho2, rho3};
    int32_t rate[kAxes];
    int32_t acceleration[kAxes];
    for (uint8_t axis = 0; axis < kAxes; ++axis) {
      rate[axis] = board.interpolator().end().rate[axis];
      acceleration[axis] = (rate_of(to[axis]) - rate[axis]) / protocol::SEGMENT_TICKS;
    }
    return board.push(segment(rate, acceleration));
  }

 private:
  static constexpr double kStart = 100;
  static constexpr double kFullSpeed = 2.0;   // counts per ms at PWM 255
  static constexpr double kFriction = 6;      // PWM
  static constexpr double kTimeConstantMs = 15;
  static constexpr double kSpring = 3;        // PWM per count

  uint8_t levels() const {
    uint8_t pressed = cut | stuck;
    for (uint8_t axis = 0; axis < kAxes; ++axis) {
      if (place[axis] < -50) pressed |= 1 << axis;
    }
    return pressed;
  }

  void step(uint8_t pins) {
    for (uint8_t axis = 0; axis < kRails; ++axis) {
      if (pins & 1 << axis) place[axis] += pins & 1 << (axis + kBackwardsShift) ? -1 : 1;
    }
  }

  void move_slide() {
    double drive = outputs.drives_on && !jammed ? outputs.pwm : 0;
    const double spring = std::min(std::max(place[kSlide] - wall, 0.0) * kSpring, std::max(drive, 0.0));
    drive -= spring;  // the screw locks itself: nothing pushes it back
    if (std::fabs(drive) < kFriction && std::fabs(speed_) < 0.05) drive = speed_ = 0;
    speed_ += (drive / 255 * kFullSpeed - speed_) / kTimeConstantMs;
    if (jammed) speed_ = 0;
    place[kSlide] += speed_;
  }

  double speed_ = 0;
};

inline bool homed(const Stand& s) { return s.report().flags & protocol::HOMED; }

// In motion at 2000 steps/s on the rails, with a queue behind it.
inline void start_motion(Stand& s) {
  s.home();
  CHECK_EQUAL(s.ramp(2000, -2000, 0), protocol::Refusal::NONE);
  for (int i = 0; i < 8; ++i) CHECK_EQUAL(s.ramp(2000, -2000, 0), protocol::Refusal::NONE);
  s.run(60);
  CHECK_EQUAL(s.board.state(), protocol::State::RUN);
}

inline void latched(Stand& s, protocol::Fault fault, bool drives_on) {
  CHECK(s.run_until([&] { return !s.board.moving(); }, 2000) >= 0);
  CHECK_EQUAL(s.board.state(), protocol::State::FAULT);
  CHECK_EQUAL(s.board.fault(), fault);
  CHECK_EQUAL(s.board.drives_on(), drives_on);
}

}  // namespace stand
