#include "homing.hpp"

namespace plugpilot {
namespace {

constexpr int8_t kTowardsSwitch = -1;
constexpr int8_t kAway = 1;

uint32_t smaller(uint32_t a, uint32_t b) { return a < b ? a : b; }

int32_t bounded(int32_t value, int32_t least, int32_t most) {
  if (value < least) return least;
  return value > most ? most : value;
}

}  // namespace

void Homing::begin() {
  axis_ = kSlide;
  start(Phase::SEEK);
}

Homing::Result Homing::step(uint8_t pressed_axes, bool slide_arrived) {
  if (plan_.pending()) {
    plan_.push_next(interpolator_);
    return Result::RUNNING;
  }
  const bool pressed = pressed_axes & (1 << axis_);
  const bool at_rest = !interpolator_.running() && slide_arrived;
  switch (phase_) {
    case Phase::SEEK:
      return found_or_failed(at_rest, pressed, Phase::SEEK_BRAKE);
    case Phase::LEAVE:
      return found_or_failed(at_rest, !pressed, Phase::LEAVE_BRAKE);
    case Phase::LOCATE:
      return found_or_failed(at_rest, pressed, Phase::LOCATE_BRAKE);
    default:
      return at_rest ? after_brake() : Result::RUNNING;
  }
}

// The switch has changed as it should, or the way was too short for it.
Homing::Result Homing::found_or_failed(bool at_rest, bool found, Phase brake_phase) {
  if (found) {
    found_at_ = axis_ == kSlide ? encoder_.counts() : position(axis_);
    interpolator_.brake();
    phase_ = brake_phase;
    return Result::RUNNING;
  }
  return at_rest ? Result::FAILED : Result::RUNNING;
}

Homing::Result Homing::after_brake() {
  // the slide keeps its set point: it stands there already
  interpolator_.settle(position(kSlide));
  switch (phase_) {
    case Phase::SEEK_BRAKE:
      return next(Phase::LEAVE);
    case Phase::LEAVE_BRAKE:
      return next(Phase::BACK_OFF);
    case Phase::BACK_OFF:
      return next(Phase::LOCATE);
    case Phase::LOCATE_BRAKE:
      take_place();
      return after_locating();
    case Phase::CHOOSE_HEIGHT:
      axis_ = 0;
      return next(Phase::SEEK);
    case Phase::RAILS_TO_REST:
      return next(Phase::SLIDE_TO_REST);
    default:
      return Result::DONE;
  }
}

Homing::Result Homing::after_locating() {
  if (axis_ == kSlide) return next(Phase::CHOOSE_HEIGHT);
  if (axis_ == kRails - 1) return next(Phase::RAILS_TO_REST);
  ++axis_;
  return next(Phase::SEEK);
}

Homing::Result Homing::next(Phase phase) {
  return start(phase) ? Result::RUNNING : Result::FAILED;
}

bool Homing::start(Phase phase) {
  phase_ = phase;
  const protocol::ConfigAxis& axis = config_.axis[axis_];
  const uint32_t stroke = static_cast<uint32_t>(axis.travel_max - axis.travel_min);
  switch (phase) {
    case Phase::SEEK:
      return seek(axis.seek_rate, stroke + axis.beyond_travel, kTowardsSwitch);
    case Phase::LEAVE:
      return seek(axis.seek_rate, axis.beyond_travel, kAway);
    case Phase::BACK_OFF:
      return seek(axis.seek_rate, axis.back_off, kAway);
    case Phase::LOCATE:
      return seek(axis.locate_rate, axis.back_off + axis.beyond_travel, kTowardsSwitch);
    case Phase::CHOOSE_HEIGHT:
      return choose_height();
    case Phase::RAILS_TO_REST:
      return rails_to_rest();
    case Phase::SLIDE_TO_REST:
      return slide_to_rest();
    default:
      return true;
  }
}

bool Homing::move(const Trapezoid& motion) {
  return plan_.begin(motion, interpolator_.free_places());
}

bool Homing::seek(uint32_t rate, uint32_t units, int8_t direction) {
  Trapezoid motion = {{0, 0, 0}, rate, config_.axis[axis_].homing_acceleration};
  motion.way[axis_] = direction * static_cast<int32_t>(units);
  if (axis_ != kSlide) motion.way[1 - axis_] = -motion.way[axis_];
  return move(motion);
}

// Along the rail no further than necessary, but with room for wrong stored positions.
bool Homing::choose_height() {
  const int32_t sum = config_.homing.carriage_sum;
  const int32_t room = static_cast<int32_t>(config_.axis[0].beyond_travel);
  const int32_t rho1 = bounded((sum + position(0) - position(1)) / 2, room, sum - room);
  return move_rails(rho1, sum - rho1);
}

bool Homing::rails_to_rest() {
  return move_rails(config_.homing.rest_position[0], config_.homing.rest_position[1]);
}

bool Homing::slide_to_rest() {
  const protocol::ConfigAxis& slide = config_.axis[kSlide];
  const int32_t way = config_.homing.rest_position[kSlide] - position(kSlide);
  return move({{0, 0, way}, slide.seek_rate, slide.homing_acceleration});
}

bool Homing::move_rails(int32_t rho1, int32_t rho2) {
  const protocol::ConfigAxis* rail = config_.axis;
  return move({{rho1 - position(0), rho2 - position(1), 0},
               smaller(rail[0].seek_rate, rail[1].seek_rate),
               smaller(rail[0].homing_acceleration, rail[1].homing_acceleration)});
}

// The switch sees the axis itself, so its place is where the axis was when it closed.
void Homing::take_place() {
  const int32_t moved = config_.axis[axis_].switch_position - found_at_;
  int32_t place[kAxes] = {position(0), position(1), position(kSlide)};
  place[axis_] += moved;
  if (axis_ == kSlide) encoder_.renumber(encoder_.counts() + moved);
  interpolator_.renumber(place);
}

// Set points: the slide stands a little beside its own.
int32_t Homing::position(uint8_t axis) const {
  const SetPoint now = interpolator_.set_point();
  return axis == kSlide ? whole_part(now.slide_position) : now.rail_position[axis];
}

}  // namespace plugpilot
