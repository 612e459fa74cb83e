// The temperature sensor of the Me Auriga: an NTC of 10 kOhm to ground, 10 kOhm to the supply.
#pragma once
#include <stdint.h>

namespace plugpilot {

// [0.1 degC] at every 64th value of the converter, from B = 3380 K and 10 kOhm at 25 degC; the ends
// are those of the values 16 and 1008. A logarithm takes longer and 3 kB.
constexpr int16_t kThermistorDc[] = {1967, 1186, 868, 693, 570, 473, 391, 318, 250,
                                     185, 121, 56, -13, -91, -187, -325, -548};
constexpr uint8_t kThermistorStep = 64;

// [0.1 degC] of a value of the converter, 0 to 1023; within 1 degC from 0 to 60 degC.
inline int16_t temperature_dc(uint16_t value) {
  const uint8_t place = static_cast<uint8_t>(value / kThermistorStep);
  const int16_t below = kThermistorDc[place];
  const int16_t way = static_cast<int16_t>(kThermistorDc[place + 1] - below);
  const int32_t share = static_cast<int32_t>(way) * static_cast<int16_t>(value % kThermistorStep);
  return static_cast<int16_t>(below + share / kThermistorStep);
}

// 10 bits of 5 V behind a divider by three.
inline uint16_t supply_mv(uint16_t value) {
  return static_cast<uint16_t>(static_cast<uint32_t>(value) * 15000 / 1024);
}

}  // namespace plugpilot
