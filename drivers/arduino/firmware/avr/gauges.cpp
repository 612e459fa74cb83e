#include "gauges.hpp"

#include "../core/thermistor.hpp"
#include "pins.hpp"

namespace plugpilot {
namespace gauges {
namespace {

constexpr uint8_t kReference = _BV(REFS0);  // the supply of the processor, 5 V

// Values of the converter in 2^-4, smoothed over 16 measurements; 0 before the first.
struct Gauge {
  uint8_t channel;
  uint16_t smoothed_q4;

  void take(uint16_t value) {
    if (smoothed_q4 == 0) smoothed_q4 = static_cast<uint16_t>(value << 4);
    smoothed_q4 = static_cast<uint16_t>(smoothed_q4 - (smoothed_q4 >> 4) + value);
  }
  uint16_t value() const { return smoothed_q4 >> 4; }
};

Gauge gauge[] = {{SUPPLY_CHANNEL, 0}, {THERMISTOR_CHANNEL, 0}};
uint8_t measured = 0;

void measure() {
  ADMUX = kReference | gauge[measured].channel;
  ADCSRA |= _BV(ADSC);
}

}  // namespace

void start() {
  ADCSRA = _BV(ADEN) | _BV(ADPS2) | _BV(ADPS1) | _BV(ADPS0);  // 125 kHz: 0.1 ms each
  measure();
}

void every_millisecond() {
  if (ADCSRA & _BV(ADSC)) return;
  gauge[measured].take(ADC);
  measured = !measured;
  measure();
}

void read(Inputs& inputs) {
  inputs.supply_mv = supply_mv(gauge[0].value());
  const bool known = gauge[1].smoothed_q4 != 0;
  inputs.temperature_dc = known ? temperature_dc(gauge[1].value()) : INT16_MIN;
}

}  // namespace gauges
}  // namespace plugpilot
