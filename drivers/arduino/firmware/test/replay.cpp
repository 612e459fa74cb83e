// Follows segments with the firmware's own code, for tests on the host's side of the link.
//
// Input: a first line `whole phase` three times, where the axes stand; then one line a segment:
// `ticks rate rate rate acceleration acceleration acceleration`, each segment begun where the one
// before it ended. Output: a line a segment, `whole phase` three times, after its last tick. The
// steps are counted at the pins.
#include <cstdlib>
#include <iostream>
#include <vector>

#include "../core/interpolator.hpp"

using namespace plugpilot;

namespace {

std::vector<Segment> read_segments() {
  std::vector<Segment> segments;
  Segment segment = {};
  while (std::cin >> segment.ticks) {
    for (int32_t& rate : segment.rate) std::cin >> rate;
    for (int32_t& acceleration : segment.acceleration) std::cin >> acceleration;
    if (!std::cin) break;
    segments.push_back(segment);
  }
  if (!std::cin.eof()) {
    std::cerr << "segment " << segments.size() << " cannot be read\n";
    std::exit(1);
  }
  return segments;
}

void push(Interpolator& interpolator, const Segment& segment) {
  QueueEnd reached = interpolator.end();
  for (uint8_t axis = 0; axis < kAxes; ++axis) reached.rate[axis] = segment.rate[axis];
  reached.append(segment);
  if (interpolator.push(segment, reached, false)) return;
  std::cerr << "the queue ran empty in motion\n";
  std::exit(1);
}

void print(const Interpolator& interpolator, const int32_t (&stepped)[kRails]) {
  for (uint8_t axis = 0; axis < kRails; ++axis) {
    std::cout << stepped[axis] << " " << interpolator.rail_phase(axis) << " ";
  }
  const int64_t slide = interpolator.set_point().slide_position;
  std::cout << whole_part(slide) << " " << phase_part(slide) << "\n";
}

}  // namespace

int main() {
  int32_t whole[kAxes];
  uint32_t phase[kAxes];
  for (uint8_t axis = 0; axis < kAxes; ++axis) std::cin >> whole[axis] >> phase[axis];
  const std::vector<Segment> segments = read_segments();
  if (segments.empty()) return 0;

  Interpolator interpolator;
  interpolator.renumber(whole);
  interpolator.take_over_phases(phase);
  int32_t stepped[kRails] = {whole[0], whole[1]};
  push(interpolator, segments.front());
  for (size_t i = 0; i < segments.size(); ++i) {
    if (i + 1 < segments.size()) push(interpolator, segments[i + 1]);
    for (uint16_t tick = 0; tick < segments[i].ticks; ++tick) {
      const uint8_t pins = interpolator.tick(0);
      for (uint8_t axis = 0; axis < kRails; ++axis) {
        if (pins & 1 << axis) stepped[axis] += pins & 1 << (axis + kBackwardsShift) ? -1 : 1;
      }
    }
    print(interpolator, stepped);
  }
  return 0;
}
