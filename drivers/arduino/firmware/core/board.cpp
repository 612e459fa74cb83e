// What goes on in the board by itself.
#include "board.hpp"

namespace plugpilot {
namespace {

using protocol::EventKind;
using protocol::Fault;
using protocol::State;

constexpr uint8_t kStopCircuitDebounceMs = 2;  // a spark of the contactor is shorter
constexpr uint8_t kQuietMs = 10;               // without an encoder count: the slide stands
constexpr uint16_t kLongestSettlingMs = 500;   // a slide that hums about its place has to do, too
constexpr uint8_t kLightsMs = 2;               // in the first of them the lights change

bool releases_drives(Fault fault) {
  return fault == Fault::EMERGENCY_STOP || fault == Fault::HEARTBEAT_LOST ||
         fault == Fault::SEGMENT_MISMATCH;
}

uint16_t flag(bool set, protocol::TelemetryFlag bit) {
  return set ? static_cast<uint16_t>(bit) : 0;
}

uint8_t bit(uint8_t axis) { return static_cast<uint8_t>(1 << axis); }

}  // namespace

bool Board::in_motion_state() const {
  return state_ == State::RUN || state_ == State::HOMING || state_ == State::STOPPING;
}

void Board::brake() {
  interpolator_.brake();
  begin_settling();
}

// From READY. The lights cannot change while an axis steps, so they get time to do it before.
void Board::begin_motion() {
  interpolator_.hold();
  start_in_ms_ = kLightsMs;
  state_ = State::RUN;
  moving_ = true;
}

void Board::begin_settling() {
  settling_ = true;
  start_in_ms_ = 0;
  settling_ms_ = quiet_ms_ = 0;
  moving_ = true;
}

// Stop as the fault demands and latch it; the first of several stays.
void Board::latch(Fault fault, uint8_t axes) {
  const bool braking = settling_;
  switch (fault) {
    case Fault::LIMIT_SWITCH:
      interpolator_.halt();
      interpolator_.settle(encoder_.counts());
      begin_settling();
      homed_ = false;
      break;
    case Fault::STALL:
    case Fault::FOLLOWING_ERROR:
      if (fault == Fault::FOLLOWING_ERROR || slide_.pushes_unseen()) homed_ = false;
      interpolator_.brake_and_hold_slide(encoder_.counts());
      begin_settling();
      slide_.reset();
      break;
    default:
      if (!braking) brake();
      break;
  }
  release_when_stopped_ = release_when_stopped_ || releases_drives(fault);
  if (fault_ == Fault::NONE) {
    fault_ = fault;
    fault_axes_ = axes;
    tell(EventKind::FAULT_LATCHED, static_cast<uint8_t>(fault), axes);
  }
  state_ = State::FAULT;
}

void Board::look_for_faults(const Inputs& inputs) {
  look_at_stop_circuit(inputs.stop_circuit_open);
  look_at_host();
  look_at_switches(inputs.tripped);
  look_at_slide();
  look_at_arrival();
}

// The button has cut the power of the motors, so nobody knows where the carriages went.
void Board::look_at_stop_circuit(bool open) {
  if (!open) {
    stop_circuit_open_ms_ = 0;
  } else if (stop_circuit_open_ms_ < kStopCircuitDebounceMs) {
    if (++stop_circuit_open_ms_ != kStopCircuitDebounceMs) return;
    latch(Fault::EMERGENCY_STOP, 0);
    homed_ = false;
  }
}

void Board::look_at_host() {
  if (silence_ms_ < UINT8_MAX) ++silence_ms_;
  if (silence_ms_ != protocol::HEARTBEAT_TIMEOUT_MS) return;
  if (drives_on_ || moving_) latch(Fault::HEARTBEAT_LOST, 0);
}

void Board::look_at_switches(uint8_t tripped) {
  const uint8_t pressed = in_motion_state() && homed_ ? pressed_ : 0;
  if (tripped | pressed) latch(Fault::LIMIT_SWITCH, tripped | pressed);
}

void Board::look_at_slide() {
  if (!in_motion_state()) return;
  if (interpolator_.ran_empty()) {
    latch(state_ == State::HOMING ? Fault::HOMING_FAILED : Fault::QUEUE_UNDERRUN, 0);
    return;
  }
  const int32_t error = slide_error();
  if (state_ != State::STOPPING && slide_.stalled()) {
    latch(Fault::STALL, bit(kSlide));
  } else if (error > config_.rho3.following_error || -error > config_.rho3.following_error) {
    latch(Fault::FOLLOWING_ERROR, bit(kSlide));
  }
}

void Board::look_at_arrival() {
  arrived_ = arrival_.update(interpolator_.running(), encoder_.counts(), slide_error(),
                             config_.rho3);
  const bool awaited = state_ == State::RUN || state_ == State::HOMING;
  if (awaited && arrived_ == Arrival::Answer::MISSED) latch(Fault::FOLLOWING_ERROR, bit(kSlide));
}

void Board::step_homing() {
  if (state_ != State::HOMING) return;
  switch (homing_.step(pressed_, arrived_ == Arrival::Answer::ARRIVED)) {
    case Homing::Result::DONE:
      homed_ = true;
      state_ = State::READY;
      tell(EventKind::HOMING_DONE, 0, 0);
      break;
    case Homing::Result::FAILED:
      latch(Fault::HOMING_FAILED, bit(homing_.axis()));
      break;
    case Homing::Result::RUNNING:
      break;
  }
}

int32_t Board::slide_error() const { return whole_part(now_.slide_position) - encoder_.counts(); }

void Board::take_over_slide() {
  interpolator_.settle(encoder_.counts());
  now_.slide_position = interpolator_.end().position[kSlide];
  slide_.reset();
}

// A stop under way: how far it is.
void Board::settle() {
  const bool running = interpolator_.running();
  quiet_ms_ = running || encoder_.counts() != last_counts_ ? 0 : quiet_ms_ + 1;
  if (!running) ++settling_ms_;
  if (quiet_ms_ < kQuietMs && settling_ms_ < kLongestSettlingMs) return;
  settling_ = false;
  take_over_slide();
  if (release_when_stopped_) drives_on_ = false;
  release_when_stopped_ = false;
  if (state_ == State::STOPPING) state_ = drives_on_ ? State::READY : State::IDLE;
}

void Board::come_to_rest() {
  if (settling_) {
    settle();
  } else if (state_ == State::RUN && arrived_ == Arrival::Answer::ARRIVED) {
    state_ = State::READY;
  }
  last_counts_ = encoder_.counts();
  moving_ = settling_ || interpolator_.running() || in_motion_state();
  // what is turned by hand stands where it is measured
  if (!drives_on_ && !moving_ && slide_error() != 0) take_over_slide();
}

void Board::drive_slide() {
  if (!drives_on_) {
    slide_.reset();
    return;
  }
  slide_.update(now_.slide_position, now_.rate[kSlide], encoder_);
}

Outputs Board::every_millisecond(const Inputs& inputs) {
  Outputs outputs = {};
  for (uint8_t axis = 0; axis < kAxes; ++axis) {
    const uint8_t flags = config_.axis[axis].flags;
    // normally closed to ground: low while released
    if (flags & protocol::SWITCH_CLOSES) outputs.released_levels |= bit(axis);
    if (flags & protocol::REVERSED) outputs.reversed |= bit(axis);
  }
  pressed_ = inputs.switch_levels ^ outputs.released_levels;
  const bool backwards = config_.axis[kSlide].flags & protocol::ENCODER_REVERSED;
  encoder_.sample(backwards ? -inputs.encoder_raw : inputs.encoder_raw);
  supply_mv_ = inputs.supply_mv;
  temperature_dc_ = inputs.temperature_dc;
  if (start_in_ms_ != 0 && --start_in_ms_ == 0) interpolator_.release();

  now_ = interpolator_.set_point();

  look_for_faults(inputs);
  step_homing();
  drive_slide();
  come_to_rest();

  outputs.drives_on = drives_on_;
  outputs.pwm = slide_.pwm();
  outputs.watched = homed_ ? bit(kAxes) - 1 : 0;
  outputs.lights_may_change = interpolator_.held() || !interpolator_.running();
  return outputs;
}

void Board::tell(EventKind kind, uint8_t code, uint8_t axes) {
  if (event_count_ == sizeof events_ / sizeof *events_) return;
  events_[event_count_++] = protocol::Event{kind, code, 0, axes, interpolator_.set_point().tick};
}

bool Board::take_event(protocol::Event& event) {
  if (event_count_ == 0) return false;
  event = events_[0];
  events_[0] = events_[1];
  --event_count_;
  return true;
}

uint16_t Board::flags() const {
  return flag(drives_on_, protocol::ENABLED) | flag(homed_, protocol::HOMED) |
         flag(pressed_ & bit(0), protocol::SWITCH_RHO1) |
         flag(pressed_ & bit(1), protocol::SWITCH_RHO2) |
         flag(pressed_ & bit(2), protocol::SWITCH_RHO3) |
         flag(stop_circuit_open_ms_ > 0, protocol::ESTOP_OPEN) | flag(moving_, protocol::MOVING) |
         flag(slide_.force_limited(), protocol::FORCE_LIMITED) |
         flag(kept_damaged_, protocol::KEPT_DAMAGED);
}

void Board::report(protocol::Telemetry& telemetry) const {
  const SetPoint now = interpolator_.set_point();  // newer than this millisecond's
  telemetry.tick = now.tick;
  telemetry.state = state_;
  telemetry.fault = fault_;
  telemetry.fault_detail = fault_axes_;
  telemetry.flags = flags();
  telemetry.commanded[0] = now.rail_position[0];
  telemetry.commanded[1] = now.rail_position[1];
  telemetry.commanded[kSlide] = whole_part(now.slide_position);
  telemetry.measured_rho3 = encoder_.counts();
  for (uint8_t axis = 0; axis < kAxes; ++axis) {
    telemetry.commanded_rate[axis] =
        static_cast<int16_t>(now.rate[axis] >> protocol::RATE_BITS_DROPPED);
  }
  // [2^-8 counts/ms] to [2^-15 counts/tick]
  telemetry.measured_rate_rho3 =
      static_cast<int16_t>(encoder_.speed_q8() * 128 / kTicksPerMillisecond);
  telemetry.pwm = slide_.pwm();
  telemetry.force_dn = slide_.force_dn();
  telemetry.queue_used = now.queue_used;
  telemetry.next_segment = next_segment_;
  telemetry.segment = now.in_host_segment ? now.segment_number : next_segment_;
  telemetry.segment_tick = now.in_host_segment ? now.segment_tick : 0;
  telemetry.supply_mv = supply_mv_;
  telemetry.temperature_dc = temperature_dc_;
}

}  // namespace plugpilot
