// Generated from protocol/messages.toml by protocol/generate.py. Do not edit.
//
// The structs are payloads as they travel: packed, little endian like the AVR and every host that
// runs the tests. Copy them from and to frames with memcpy.
#pragma once

#include <stdint.h>

namespace plugpilot {
namespace protocol {

constexpr uint32_t PROTOCOL_HASH = 0x13345A36UL;
constexpr uint32_t BAUD = 500000UL;  // Bits per second, 8N1
constexpr uint16_t TICK_HZ = 20000;  // Ticks per second; a stepper makes at most one step per tick
constexpr uint8_t PHASE_BITS = 31;  // Binary digits of a position behind the point
constexpr uint8_t AXES = 3;  // rho1, rho2, rho3
constexpr uint8_t STEP_AXES = 2;  // The first of them are steppers
constexpr uint8_t QUEUE_CAPACITY = 16;  // Segments the board holds, the running one included
constexpr uint16_t SEGMENT_TICKS = 400;  // Ticks of a segment that the board is made for: 20 ms
constexpr uint16_t MAX_SEGMENT_TICKS = 2000;  // Ticks of the longest segment
constexpr uint8_t MAX_FRAME_BYTES = 64;  // Of an encoded frame, its delimiter included
constexpr uint8_t WINDOW = 8;  // Sequenced messages under way before the host waits
constexpr uint8_t RETRANSMIT_MS = 30;  // Without progress the host sends the window again
constexpr uint8_t HEARTBEAT_PERIOD_MS = 50;  // The host sends one this often
constexpr uint8_t HEARTBEAT_TIMEOUT_MS = 200;  // Silence after which the board stops by itself
constexpr uint8_t TELEMETRY_MOVING_MS = 10;  // Period of the telemetry while anything moves
constexpr uint8_t TELEMETRY_REST_MS = 100;  // Period of the telemetry at rest
constexpr uint8_t TELEMETRY_CHANGE_MS = 2;  // A change is told at once, but not sooner after the last telemetry
constexpr uint8_t ARRIVED_MS = 10;  // rho3 has arrived when it stood so long within config_rho3.settled
constexpr uint16_t ARRIVAL_STANDSTILL_MS = 500;  // Standing so long elsewhere it will not arrive any more
constexpr uint16_t ARRIVAL_TIMEOUT_MS = 3000;  // Nor will it so long after its set point has come to rest
constexpr uint16_t HELLO_PERIOD_MS = 500;  // A board without a session says HELLO this often
constexpr uint8_t RATE_BITS_DROPPED = 16;  // Telemetry rates are rates shifted right by this
constexpr uint8_t HEADER_BYTES = 4;  // length, type, seq, ack
constexpr uint8_t CRC_BYTES = 2;
constexpr uint8_t MAX_PAYLOAD_BYTES = 53;

// What the board does.
enum class State : uint8_t {
  BOOT = 0,
  IDLE = 1,
  HOMING = 2,
  READY = 3,
  RUN = 4,
  STOPPING = 5,
  FAULT = 6,
};

// Why the board latched a fault.
enum class Fault : uint8_t {
  NONE = 0,
  EMERGENCY_STOP = 1,
  LIMIT_SWITCH = 2,
  FOLLOWING_ERROR = 3,
  STALL = 4,
  QUEUE_UNDERRUN = 5,
  HEARTBEAT_LOST = 6,
  SEGMENT_MISMATCH = 7,
  HOMING_FAILED = 8,
  WATCHDOG = 9,
};

// Why the board refused a sequenced message.
enum class Refusal : uint8_t {
  NONE = 0,
  NOT_CONFIGURED = 1,
  DRIVES_OFF = 2,
  HOMING = 3,
  MOVING = 4,
  STOPPING = 5,
  FAULT_LATCHED = 6,
  NOT_HOMED = 7,
  QUEUE_FULL = 8,
  WRONG_NUMBER = 9,
  BAD_TICKS = 10,
  DISCONTINUOUS = 11,
  RATE_JUMP = 12,
  TOO_FAST = 13,
  BEYOND_TRAVEL = 14,
  BAD_VALUE = 15,
  CAUSE_PRESENT = 16,
  CONFIG_CRC = 17,
  NOT_AT_REST = 18,
};

// What an EVENT tells.
enum class EventKind : uint8_t {
  FAULT_LATCHED = 1,
  HOMING_DONE = 2,
  REFUSED = 3,
};

// Of IEC 60204-1.
enum class StopCategory : uint8_t {
  DECELERATE_AND_RELEASE = 1,
  DECELERATE_AND_HOLD = 2,
};

// Which hardware answers.
enum class BoardKind : uint8_t {
  ME_AURIGA = 1,
};

// Why the board started.
enum class ResetCause : uint8_t {
  UNKNOWN = 0,
  POWER_ON = 1,
  EXTERNAL = 2,
  BROWN_OUT = 3,
  WATCHDOG = 4,
};

// Bits of telemetry.flags.
enum TelemetryFlag : uint16_t {
  ENABLED = 1U << 0,
  HOMED = 1U << 1,
  SWITCH_RHO1 = 1U << 2,
  SWITCH_RHO2 = 1U << 3,
  SWITCH_RHO3 = 1U << 4,
  ESTOP_OPEN = 1U << 5,
  MOVING = 1U << 6,
  FORCE_LIMITED = 1U << 7,
  LATE_TICK = 1U << 8,
  RX_OVERRUN = 1U << 9,
  KEPT_DAMAGED = 1U << 10,
};

// Bits of config_axis.flags.
enum AxisFlag : uint16_t {
  REVERSED = 1U << 0,
  SWITCH_CLOSES = 1U << 1,
  ENCODER_REVERSED = 1U << 2,
};

enum class MessageType : uint8_t {
  HELLO_REQUEST = 0x01,
  HEARTBEAT = 0x02,
  CLOCK = 0x03,
  STOP = 0x04,
  EMERGENCY_STOP = 0x05,
  CONFIG_AXIS = 0x10,
  CONFIG_RHO3 = 0x11,
  CONFIG_HOMING = 0x12,
  CONFIG_COMMIT = 0x13,
  ENABLE = 0x20,
  DISABLE = 0x21,
  HOME = 0x22,
  FORCE_LIMIT = 0x23,
  CLEAR_FAULT = 0x24,
  SEGMENT = 0x25,
  HELLO = 0x81,
  CLOCK_REPLY = 0x82,
  ACK = 0x83,
  EVENT = 0x84,
  TELEMETRY = 0x85,
};

// Begin a session: sequence numbers start at 0. The same session again changes nothing.
struct __attribute__((packed)) HelloRequest {
  uint32_t protocol_hash;  // Of the host; with another than its own the board begins no session
  uint16_t session;  // Chosen by the host, not 0
};
static_assert(sizeof(HelloRequest) == 6, "HelloRequest has another size on the wire");

// The host is alive. Watched from the session's start while the drives are on.
struct Heartbeat {};  // no payload

// Ask for the board's time.
struct __attribute__((packed)) Clock {
  uint16_t token;  // Comes back in the reply
};
static_assert(sizeof(Clock) == 2, "Clock has another size on the wire");

// Drop the queue and decelerate; honoured at once in every state.
struct __attribute__((packed)) Stop {
  StopCategory category;  // Release or hold
  uint8_t token;  // Comes back as stop_token, so that the host can repeat it
};
static_assert(sizeof(Stop) == 2, "Stop has another size on the wire");

// Category 1 stop, then latch a fault; honoured at once in every state.
struct __attribute__((packed)) EmergencyStop {
  Fault fault;  // SEGMENT_MISMATCH (also unhomes) or EMERGENCY_STOP, which any other value means
  uint8_t token;  // Comes back as stop_token
};
static_assert(sizeof(EmergencyStop) == 2, "EmergencyStop has another size on the wire");

// Configuration of one axis; with the drives off. In force from CONFIG_COMMIT.
struct __attribute__((packed)) ConfigAxis {
  uint8_t axis;  // 0, 1, 2 for rho1, rho2, rho3
  uint8_t flags;  // AxisFlag
  uint32_t units_per_mm_q16;  // Scale; the board only keeps it [2^-16 units/mm]
  int32_t travel_min;  // Smallest position of a segment [units]
  int32_t travel_max;  // Largest position of a segment [units]
  int32_t switch_position;  // Where homing finds the switch [units]
  uint32_t max_rate;  // Largest rate of a segment; below 2^31 [rate]
  uint32_t max_rate_jump;  // Largest jump between segments [rate]
  uint32_t stop_deceleration;  // Of a stop [acceleration]
  uint32_t seek_rate;  // Homing: first search [rate]
  uint32_t locate_rate;  // Homing: second, slow search [rate]
  uint32_t homing_acceleration;  // Homing: ramps [acceleration]
  uint32_t back_off;  // Homing: way behind the switch's opening [units]
  uint32_t beyond_travel;  // Homing: search this much further than the travel [units]
};
static_assert(sizeof(ConfigAxis) == 50, "ConfigAxis has another size on the wire");

// Configuration of the closed loop of rho3 at 1 kHz. PWM runs from -255 to 255.
struct __attribute__((packed)) ConfigRho3 {
  uint16_t kp_q8;  // Proportional gain [2^-8 PWM/count]
  uint16_t ki_q16;  // Integral gain [2^-16 PWM/(count ms)]
  uint16_t kd_q8;  // Gain on the velocity error [2^-8 PWM/(count/ms)]
  uint8_t integral_pwm_max;  // Largest share of the integral [PWM]
  uint8_t friction_pwm;  // Overcomes dry friction; not counted as force [PWM]
  uint16_t back_emf_q8;  // Speed voltage; not counted as force [2^-8 PWM/(count/ms)]
  uint16_t pwm_per_newton_q8;  // Not 0 [2^-8 PWM/N]
  uint16_t force_limit_dn;  // In force until FORCE_LIMIT [0.1 N]
  uint16_t force_max_dn;  // Largest FORCE_LIMIT [0.1 N]
  uint16_t stall_ms;  // PWM at its cap without a count: stalled [ms]
  uint16_t following_error;  // Larger is a fault [counts]
  uint16_t settled;  // Nearer has arrived [counts]
  uint16_t near;  // Nearer will do if it stands still; at least settled [counts]
};
static_assert(sizeof(ConfigRho3) == 24, "ConfigRho3 has another size on the wire");

// Homing: rho3, then rho1 and rho2 at constant height, then the rest position.
struct __attribute__((packed)) ConfigHoming {
  int32_t carriage_sum;  // rho1 + rho2 while a carriage seeks its switch [units]
  int32_t rest_position[3];  // Where homing ends [units]
};
static_assert(sizeof(ConfigHoming) == 16, "ConfigHoming has another size on the wire");

// Put the configuration in force. BOOT becomes IDLE; homed is lost.
struct __attribute__((packed)) ConfigCommit {
  uint16_t crc;  // CRC-16 over the payloads CONFIG_AXIS 0, 1, 2, CONFIG_RHO3, CONFIG_HOMING
  uint8_t save;  // 1: keep it in the EEPROM, so that the next start is IDLE
};
static_assert(sizeof(ConfigCommit) == 3, "ConfigCommit has another size on the wire");

// Energise the drives: IDLE becomes READY.
struct Enable {};  // no payload

// De-energise the drives: READY becomes IDLE; refused while moving.
struct Disable {};  // no payload

// Begin homing; READY only. Ends with HOMING_DONE or a fault or a stop.
struct Home {};  // no payload

// Cap the force of rho3.
struct __attribute__((packed)) ForceLimit {
  uint16_t force_dn;  // 1 to force_max_dn [0.1 N]
};
static_assert(sizeof(ForceLimit) == 2, "ForceLimit has another size on the wire");

// Release the latched fault; refused while moving or while its cause is present.
struct ClearFault {};  // no payload

// Append constant acceleration to the queue; READY (homed) or RUN only.
struct __attribute__((packed)) Segment {
  uint16_t number;  // telemetry.next_segment; 0 after a session began
  uint16_t ticks;  // 1 to MAX_SEGMENT_TICKS [ticks]
  int32_t start[3];  // Must be the whole units of the queue's end [units]
  uint32_t phase[3];  // In motion it must be that of the queue's end; at rest it is taken over [2^-31 units]
  int32_t rate[3];  // Added to the position at the first tick [rate]
  int32_t acceleration[3];  // Added to the rate after every tick [acceleration]
};
static_assert(sizeof(Segment) == 52, "Segment has another size on the wire");

// Who the board is. Answers every HELLO_REQUEST; without a session sent by itself.
struct __attribute__((packed)) Hello {
  uint32_t protocol_hash;  // Of the definition it was built from
  uint16_t session;  // 0 before the first request
  BoardKind board;  // Hardware
  uint8_t firmware_major;  // Version
  uint8_t firmware_minor;  // Version
  uint8_t firmware_patch;  // Version
  uint16_t boot_id;  // Another one after every start
  ResetCause reset_cause;  // Why it started
  Fault previous_fault;  // Latched when it went down
  State state;  // Now
  uint8_t queue_capacity;  // Segments
  uint16_t segment_ticks;  // Of a usual segment [ticks]
  uint16_t tick_hz;  // Ticks per second [1/s]
  uint16_t config_crc;  // As in CONFIG_COMMIT; 0 in BOOT
  uint32_t tick;  // Board time [ticks]
};
static_assert(sizeof(Hello) == 26, "Hello has another size on the wire");

// The board's time when CLOCK was handled.
struct __attribute__((packed)) ClockReply {
  uint16_t token;  // Of the request
  uint32_t tick;  // Board time [ticks]
};
static_assert(sizeof(ClockReply) == 6, "ClockReply has another size on the wire");

// Sent at once after every sequenced message, wanted or not, and after every stop.
struct __attribute__((packed)) Ack {
  uint8_t events;  // EVENTs sent so far, modulo 256
  uint8_t refused_seq;  // Of the last refused message of this session
  Refusal refusal;  // Why; NONE before the first
  uint8_t stop_token;  // Of the last STOP or EMERGENCY_STOP; 0 when a session begins
};
static_assert(sizeof(Ack) == 4, "Ack has another size on the wire");

// Something happened. The frame's seq counts the EVENTs of a session, from 0.
struct __attribute__((packed)) Event {
  EventKind kind;  // What
  uint8_t code;  // Fault or Refusal, after the kind
  uint8_t seq;  // Of the refused message
  uint8_t detail;  // Bits of the axes concerned: 1, 2, 4
  uint32_t tick;  // When [ticks]
};
static_assert(sizeof(Event) == 8, "Event has another size on the wire");

// One sample of everything, all of the same instant.
struct __attribute__((packed)) Telemetry {
  uint32_t tick;  // Board time [ticks]
  State state;  // Now
  Fault fault;  // Latched, or NONE
  uint8_t fault_detail;  // Bits of the axes concerned: 1, 2, 4
  uint16_t flags;  // TelemetryFlag
  int32_t commanded[3];  // Set points; of the steppers also what was stepped [units]
  int32_t measured_rho3;  // Encoder [counts]
  int16_t commanded_rate[3];  // Rates of the set points [rate / 2^16]
  int16_t measured_rate_rho3;  // From the encoder [rate / 2^16]
  int16_t pwm;  // Of rho3, positive towards the car [PWM]
  int16_t force_dn;  // From the PWM, positive towards the car [0.1 N]
  uint8_t queue_used;  // Segments, the running one included
  uint16_t segment;  // Number of the running one; next_segment when none runs
  uint16_t segment_tick;  // Ticks of it that are done; 0 when none runs [ticks]
  uint16_t next_segment;  // Number that the next SEGMENT must have
  uint8_t bad_frames;  // Frames dropped as damaged, modulo 256
  uint8_t events;  // As in ACK
  uint8_t refused_seq;  // As in ACK
  Refusal refusal;  // As in ACK
  uint8_t stop_token;  // As in ACK
  uint16_t supply_mv;  // Supply of the board; 0 before it was measured [mV]
  int16_t temperature_dc;  // On the board; -32768 before it was measured [0.1 degC]
};
static_assert(sizeof(Telemetry) == 53, "Telemetry has another size on the wire");

constexpr uint8_t UNKNOWN_TYPE = 0xFF;

// Payload size of a message, UNKNOWN_TYPE for a number that is none.
inline uint8_t payload_bytes(uint8_t type) {
  switch (static_cast<MessageType>(type)) {
    case MessageType::HELLO_REQUEST: return 6;
    case MessageType::HEARTBEAT: return 0;
    case MessageType::CLOCK: return 2;
    case MessageType::STOP: return 2;
    case MessageType::EMERGENCY_STOP: return 2;
    case MessageType::CONFIG_AXIS: return 50;
    case MessageType::CONFIG_RHO3: return 24;
    case MessageType::CONFIG_HOMING: return 16;
    case MessageType::CONFIG_COMMIT: return 3;
    case MessageType::ENABLE: return 0;
    case MessageType::DISABLE: return 0;
    case MessageType::HOME: return 0;
    case MessageType::FORCE_LIMIT: return 2;
    case MessageType::CLEAR_FAULT: return 0;
    case MessageType::SEGMENT: return 52;
    case MessageType::HELLO: return 26;
    case MessageType::CLOCK_REPLY: return 6;
    case MessageType::ACK: return 4;
    case MessageType::EVENT: return 8;
    case MessageType::TELEMETRY: return 53;
  }
  return UNKNOWN_TYPE;
}

// Whether a message belongs to the host's numbered sequence.
inline bool is_sequenced(uint8_t type) {
  switch (static_cast<MessageType>(type)) {
    case MessageType::CONFIG_AXIS:
    case MessageType::CONFIG_RHO3:
    case MessageType::CONFIG_HOMING:
    case MessageType::CONFIG_COMMIT:
    case MessageType::ENABLE:
    case MessageType::DISABLE:
    case MessageType::HOME:
    case MessageType::FORCE_LIMIT:
    case MessageType::CLEAR_FAULT:
    case MessageType::SEGMENT:
      return true;
    default:
      return false;
  }
}

}  // namespace protocol
}  // namespace plugpilot
