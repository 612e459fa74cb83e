#include "configuration.hpp"

#include "crc16.hpp"

namespace plugpilot {
namespace {

using protocol::Refusal;

constexpr uint8_t kSlideAxis = protocol::AXES - 1;
constexpr uint8_t kRho3Arrived = 1 << protocol::AXES;
constexpr uint8_t kHomingArrived = kRho3Arrived << 1;
constexpr uint8_t kAllArrived = (kHomingArrived << 1) - 1;

// Positions stay far from the ends of 32 bits, so that sums of a few never overflow.
constexpr int32_t kFurthestUnits = INT32_C(1) << 28;

// The closed loop of rho3 computes in 2^-8 counts.
constexpr int32_t kFurthestCounts = INT32_C(1) << 21;

bool is_rate(uint32_t value) { return value > 0 && value <= INT32_MAX; }
bool is_place(int32_t units) { return units >= -kFurthestUnits && units <= kFurthestUnits; }
bool is_way(uint32_t units) { return units <= static_cast<uint32_t>(kFurthestUnits); }

bool is_sound_axis(const protocol::ConfigAxis& axis) {
  return is_place(axis.travel_min) && is_place(axis.travel_max) &&
         axis.travel_min < axis.travel_max && is_place(axis.switch_position) &&
         is_way(axis.back_off) && is_way(axis.beyond_travel) && is_rate(axis.max_rate) &&
         axis.max_rate_jump <= INT32_MAX && is_rate(axis.stop_deceleration) &&
         is_rate(axis.seek_rate) && is_rate(axis.locate_rate) && is_rate(axis.homing_acceleration);
}

bool is_near(int32_t counts) { return counts >= -kFurthestCounts && counts <= kFurthestCounts; }

bool is_sound_slide(const protocol::ConfigAxis& axis, const protocol::ConfigRho3& slide) {
  return is_near(axis.travel_min) && is_near(axis.travel_max) && is_near(axis.switch_position) &&
         axis.back_off <= static_cast<uint32_t>(kFurthestCounts) &&
         axis.beyond_travel <= static_cast<uint32_t>(kFurthestCounts) &&
         slide.pwm_per_newton_q8 > 0 && slide.stall_ms > 0 && slide.near >= slide.settled &&
         slide.force_limit_dn > 0 && slide.force_limit_dn <= slide.force_max_dn;
}

}  // namespace

uint16_t Configuration::crc() const { return crc16(this, sizeof *this); }

bool Configuration::is_sound() const {
  for (uint8_t i = 0; i < protocol::AXES; ++i) {
    if (axis[i].axis != i || !is_sound_axis(axis[i])) return false;
    if (!is_place(homing.rest_position[i])) return false;
  }
  return is_place(homing.carriage_sum) && is_near(homing.rest_position[kSlideAxis]) &&
         is_sound_slide(axis[kSlideAxis], rho3);
}

Refusal ConfigurationDraft::put(const protocol::ConfigAxis& message) {
  if (message.axis >= protocol::AXES) return Refusal::BAD_VALUE;
  parts_.axis[message.axis] = message;
  arrived_ |= static_cast<uint8_t>(1 << message.axis);
  return Refusal::NONE;
}

void ConfigurationDraft::put(const protocol::ConfigRho3& message) {
  parts_.rho3 = message;
  arrived_ |= kRho3Arrived;
}

void ConfigurationDraft::put(const protocol::ConfigHoming& message) {
  parts_.homing = message;
  arrived_ |= kHomingArrived;
}

Refusal ConfigurationDraft::complete(uint16_t crc) const {
  if (arrived_ != kAllArrived || parts_.crc() != crc) return Refusal::CONFIG_CRC;
  return parts_.is_sound() ? Refusal::NONE : Refusal::BAD_VALUE;
}

}  // namespace plugpilot
