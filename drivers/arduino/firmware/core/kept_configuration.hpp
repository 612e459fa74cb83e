// The configuration as the EEPROM keeps it.
#pragma once
#include "configuration.hpp"

namespace plugpilot {

struct __attribute__((packed)) KeptConfiguration {
  uint32_t protocol_hash;  // of the definition that gives the bytes their meaning
  Configuration configuration;
  uint16_t crc;

  static KeptConfiguration of(const Configuration& configuration) {
    return {protocol::PROTOCOL_HASH, configuration, configuration.crc()};
  }

  // As the EEPROM comes from the factory, or from a programmer: nothing was ever kept.
  bool is_blank() const {
    return (protocol_hash == UINT32_MAX && crc == UINT16_MAX) || (protocol_hash == 0 && crc == 0);
  }

  bool is_of_this_protocol() const { return protocol_hash == protocol::PROTOCOL_HASH; }

  // As it was written, and of numbers that the board can work with.
  bool is_whole() const { return crc == configuration.crc() && configuration.is_sound(); }
};

}  // namespace plugpilot
