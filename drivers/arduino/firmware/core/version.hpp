// Version of the firmware, as HELLO tells it.
#pragma once
#include <stdint.h>

namespace plugpilot {

constexpr uint8_t kFirmwareMajor = 0;
constexpr uint8_t kFirmwareMinor = 2;
constexpr uint8_t kFirmwarePatch = 0;

}  // namespace plugpilot
