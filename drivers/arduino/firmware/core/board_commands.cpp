// What the host may ask of the board.
#include "board.hpp"
#include "segment_check.hpp"

namespace plugpilot {

using protocol::Fault;
using protocol::Refusal;
using protocol::State;
using protocol::StopCategory;

Refusal Board::why_not_ready() const {
  switch (state_) {
    case State::BOOT:
      return Refusal::NOT_CONFIGURED;
    case State::IDLE:
      return Refusal::DRIVES_OFF;
    case State::HOMING:
      return Refusal::HOMING;
    case State::RUN:
      return Refusal::MOVING;
    case State::STOPPING:
      return Refusal::STOPPING;
    case State::FAULT:
      return Refusal::FAULT_LATCHED;
    default:
      return Refusal::NONE;
  }
}

Refusal Board::why_no_configuration() const {
  // a fault must not keep the host from connecting
  return drives_on_ || moving_ ? Refusal::NOT_AT_REST : Refusal::NONE;
}

Refusal Board::configure(const Configuration& config) {
  const Refusal refusal = why_no_configuration();
  if (refusal != Refusal::NONE) return refusal;
  config_ = config;
  config_crc_ = config.crc();
  slide_.configure(config.rho3);
  int32_t deceleration[kAxes];
  for (uint8_t axis = 0; axis < kAxes; ++axis) {
    deceleration[axis] = static_cast<int32_t>(config.axis[axis].stop_deceleration);
  }
  interpolator_.set_deceleration(deceleration);
  configured_ = true;
  if (state_ == State::BOOT) state_ = State::IDLE;
  homed_ = false;
  if (!place_known_) {
    int32_t place[kAxes];
    for (uint8_t axis = 0; axis < kAxes; ++axis) place[axis] = config.homing.rest_position[axis];
    remember(place);
  }
  return Refusal::NONE;
}

Refusal Board::enable() {
  switch (state_) {
    case State::IDLE:
      take_over_slide();
      drives_on_ = true;
      silence_ms_ = 0;
      state_ = State::READY;
      return Refusal::NONE;
    case State::BOOT:
    case State::FAULT:
    case State::STOPPING:
      return why_not_ready();
    default:
      return Refusal::NONE;
  }
}

Refusal Board::disable() {
  if (moving_ || in_motion_state()) return Refusal::MOVING;
  drives_on_ = false;
  if (state_ == State::READY) state_ = State::IDLE;
  return Refusal::NONE;
}

Refusal Board::home() {
  const Refusal refusal = why_not_ready();
  if (refusal != Refusal::NONE) return refusal;
  homed_ = false;
  state_ = State::HOMING;
  moving_ = true;
  homing_.begin();
  return Refusal::NONE;
}

Refusal Board::clear_fault() {
  if (fault_ == Fault::NONE) return Refusal::NONE;
  if (moving_ || settling_) return Refusal::MOVING;
  if (stop_circuit_open_ms_ > 0) return Refusal::CAUSE_PRESENT;
  fault_ = Fault::NONE;
  fault_axes_ = 0;
  state_ = drives_on_ ? State::READY : configured_ ? State::IDLE : State::BOOT;
  return Refusal::NONE;
}

Refusal Board::limit_force(uint16_t force_dn) {
  if (!configured_) return Refusal::NOT_CONFIGURED;
  if (force_dn == 0 || force_dn > config_.rho3.force_max_dn) return Refusal::BAD_VALUE;
  slide_.limit_force(force_dn);
  return Refusal::NONE;
}

Refusal Board::push(const protocol::Segment& message) {
  if (state_ != State::READY && state_ != State::RUN) return why_not_ready();
  if (!homed_) return Refusal::NOT_HOMED;
  if (interpolator_.free_places() == 0) return Refusal::QUEUE_FULL;
  const bool running = interpolator_.running();
  QueueEnd reached;
  const Refusal refusal =
      check_segment(message, next_segment_, interpolator_.end(), running, config_, reached);
  if (refusal != Refusal::NONE) return refusal;
  Segment segment = {};
  segment.number = message.number;
  segment.ticks = message.ticks;
  segment.from_host = true;
  uint32_t phase[kAxes];
  for (uint8_t axis = 0; axis < kAxes; ++axis) {
    phase[axis] = message.phase[axis];
    segment.rate[axis] = message.rate[axis];
    segment.acceleration[axis] = message.acceleration[axis];
  }
  if (!running) interpolator_.take_over_phases(phase);
  if (state_ == State::READY) begin_motion();
  if (!interpolator_.push(segment, reached, is_rest(reached.rate, config_))) {
    return Refusal::FAULT_LATCHED;
  }
  ++next_segment_;
  return Refusal::NONE;
}

void Board::stop(StopCategory category) {
  const bool release = category == StopCategory::DECELERATE_AND_RELEASE;
  switch (state_) {
    case State::RUN:
    case State::HOMING:
      brake();
      state_ = State::STOPPING;
      release_when_stopped_ = release;
      break;
    case State::STOPPING:
      release_when_stopped_ = release_when_stopped_ || release;
      break;
    case State::READY:
      if (release) {
        drives_on_ = false;
        state_ = State::IDLE;
      }
      break;
    default:
      break;
  }
}

void Board::emergency_stop(Fault fault) {
  if (fault == Fault::SEGMENT_MISMATCH) {
    homed_ = false;
  } else {
    fault = Fault::EMERGENCY_STOP;
  }
  latch(fault, 0);
}

void Board::begin_session() {
  next_segment_ = 0;
  event_count_ = 0;
  silence_ms_ = 0;
  stop(StopCategory::DECELERATE_AND_HOLD);
}

void Board::remember(const int32_t (&position)[kAxes]) {
  place_known_ = true;
  encoder_.renumber(position[kSlide]);
  interpolator_.renumber(position);
}

}  // namespace plugpilot
