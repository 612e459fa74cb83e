// The motion board: its states, its refusals and its faults. Knows neither pins nor frames.
#pragma once
#include "arrival.hpp"
#include "configuration.hpp"
#include "encoder.hpp"
#include "homing.hpp"
#include "interpolator.hpp"
#include "slide_controller.hpp"

namespace plugpilot {

// What the hardware reports each millisecond.
struct Inputs {
  uint8_t switch_levels;   // bits of the axes: level of the switch inputs
  uint8_t tripped;         // bits of the axes whose switches ended the steps since the last time
  bool stop_circuit_open;  // emergency stop
  int32_t encoder_raw;
  uint16_t supply_mv;      // as in the telemetry
  int16_t temperature_dc;
};

// What the hardware shall do until the next millisecond.
struct Outputs {
  bool drives_on;
  int16_t pwm;              // of rho3, positive towards the car
  uint8_t watched;          // bits of the axes whose switches end the steps at once
  uint8_t released_levels;  // levels of those switches while they are not pressed
  uint8_t reversed;         // bits of the axes whose direction level is the other one
  bool lights_may_change;   // that delays ticks; before a motion there is always time for it
};

class Board {
 public:
  Board() : homing_(interpolator_, encoder_, config_) {}

  Interpolator& interpolator() { return interpolator_; }

  // --- commands; a refused one has changed nothing ---

  protocol::Refusal configure(const Configuration& config);
  protocol::Refusal enable();
  protocol::Refusal disable();
  protocol::Refusal home();
  protocol::Refusal clear_fault();
  protocol::Refusal limit_force(uint16_t force_dn);
  protocol::Refusal push(const protocol::Segment& segment);
  protocol::Refusal why_no_configuration() const;
  void stop(protocol::StopCategory category);
  void emergency_stop(protocol::Fault fault);

  // Another host, or the same one anew: segments count from 0, and nothing goes on moving.
  void begin_session();

  // Any valid frame has come.
  void hear_host() { silence_ms_ = 0; }

  // At the start: where the robot stood when the power went, and what ended the last run. Without
  // such a place the robot is taken to stand where homing ends.
  void remember(const int32_t (&position)[kAxes]);
  void start_with_fault(protocol::Fault fault) { latch(fault, 0); }

  // The configuration that was kept cannot be used.
  void miss_kept_configuration() { kept_damaged_ = true; }

  // --- time ---

  Outputs every_millisecond(const Inputs& inputs);

  // --- reports ---

  protocol::State state() const { return state_; }
  protocol::Fault fault() const { return fault_; }
  bool moving() const { return moving_; }
  bool drives_on() const { return drives_on_; }
  const Configuration& config() const { return config_; }
  bool configured() const { return configured_; }

  // TelemetryFlag, but for the link's own.
  uint16_t flags() const;

  // 0 without a configuration.
  uint16_t config_crc() const { return configured_ ? config_crc_ : 0; }

  // Fills in everything but the link's own fields.
  void report(protocol::Telemetry& telemetry) const;

  // The next thing that happened by itself, if any; seq is the link's.
  bool take_event(protocol::Event& event);

 private:
  protocol::Refusal why_not_ready() const;
  bool in_motion_state() const;
  void begin_motion();
  void begin_when_filled();
  void brake();
  void begin_settling();
  void latch(protocol::Fault fault, uint8_t axes);
  void look_for_faults(const Inputs& inputs);
  void look_at_stop_circuit(bool open);
  void look_at_host();
  void look_at_switches(uint8_t tripped);
  void look_at_slide();
  void look_at_arrival();
  void step_homing();
  void settle();
  void come_to_rest();
  void take_over_slide();
  void drive_slide();
  int32_t slide_error() const;
  void tell(protocol::EventKind kind, uint8_t code, uint8_t axes);

  Interpolator interpolator_;
  SetPoint now_ = {};  // of this millisecond
  Encoder encoder_;
  SlideController slide_;
  Arrival arrival_;
  Arrival::Answer arrived_ = Arrival::Answer::WAITING;
  Configuration config_ = {};
  uint16_t config_crc_ = 0;
  Homing homing_;
  protocol::State state_ = protocol::State::BOOT;
  protocol::Fault fault_ = protocol::Fault::NONE;
  uint8_t fault_axes_ = 0;
  bool configured_ = false;
  bool drives_on_ = false;
  bool homed_ = false;
  bool place_known_ = false;
  bool moving_ = false;
  bool kept_damaged_ = false;
  bool settling_ = false;  // a stop is under way: rho3's set point is to be taken over
  bool release_when_stopped_ = false;
  uint8_t pressed_ = 0;
  uint8_t waited_ms_ = 0;  // since the first segment of a motion that has not begun
  uint8_t stop_circuit_open_ms_ = 0;
  uint8_t quiet_ms_ = 0;
  uint16_t settling_ms_ = 0;
  uint8_t silence_ms_ = 0;
  int32_t last_counts_ = 0;
  uint16_t next_segment_ = 0;
  uint16_t supply_mv_ = 0;
  int16_t temperature_dc_ = INT16_MIN;
  protocol::Event events_[2] = {};  // a fault and the end of homing at most
  uint8_t event_count_ = 0;
};

}  // namespace plugpilot
