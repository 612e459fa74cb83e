// What the host tells the board about the robot, and whether it makes sense.
#pragma once
#include <stdint.h>

#include "protocol.hpp"

namespace plugpilot {

// Exactly the bytes over which the host computes its CRC; also the image in the EEPROM.
struct __attribute__((packed)) Configuration {
  protocol::ConfigAxis axis[protocol::AXES];
  protocol::ConfigRho3 rho3;
  protocol::ConfigHoming homing;

  uint16_t crc() const;

  // No number that the board would divide by is zero and none leaves the range it computes in.
  bool is_sound() const;
};

// Collects the messages of a new configuration beside the one in force.
class ConfigurationDraft {
 public:
  protocol::Refusal put(const protocol::ConfigAxis& message);
  void put(const protocol::ConfigRho3& message);
  void put(const protocol::ConfigHoming& message);

  // The parts as one, if all have arrived, are sound, and have the host's CRC.
  protocol::Refusal complete(uint16_t crc) const;

  const Configuration& parts() const { return parts_; }

 private:
  Configuration parts_ = {};
  uint8_t arrived_ = 0;
};

}  // namespace plugpilot
