// The interpolator and the motions that the board plans by itself.
#include <random>

#include "../core/trapezoid.hpp"
#include "check.hpp"

using namespace plugpilot;

namespace {

constexpr int32_t kDeceleration[kAxes] = {8000, 8000, 3000};

// Ticks once and follows the pins.
void tick(Interpolator& interpolator, int32_t (&stepped)[kRails]) {
  const uint8_t pins = interpolator.tick(0);
  for (uint8_t axis = 0; axis < kRails; ++axis) {
    if (pins & 1 << axis) stepped[axis] += pins & 1 << (axis + kBackwardsShift) ? -1 : 1;
  }
}

Segment segment(uint16_t ticks, const int32_t (&rate)[kAxes], const int32_t (&acceleration)[kAxes]) {
  Segment made = {};
  made.ticks = ticks;
  made.from_host = true;
  for (uint8_t axis = 0; axis < kAxes; ++axis) {
    made.rate[axis] = rate[axis];
    made.acceleration[axis] = acceleration[axis];
  }
  return made;
}

// Behind the queue, as the board does it.
bool push(Interpolator& interpolator, const Segment& next, bool ends_at_rest) {
  QueueEnd reached = interpolator.end();
  for (uint8_t axis = 0; axis < kAxes; ++axis) reached.rate[axis] = next.rate[axis];
  reached.append(next);
  return interpolator.push(next, reached, ends_at_rest);
}

bool follow(Interpolator& interpolator, const Trapezoid& motion) {
  TrapezoidPlan plan;
  if (!plan.begin(motion, interpolator.free_places())) return false;
  while (plan.pending()) {
    CHECK_EQUAL(interpolator.tick(0), 0);  // nothing moves before it is whole
    plan.push_next(interpolator);
  }
  return true;
}

}  // namespace

TEST(pins_count_what_the_closed_form_says_at_every_tick) {
  std::mt19937 random(2);
  std::uniform_int_distribution<int32_t> any_rate(-INT32_MAX, INT32_MAX);
  for (int round = 0; round < 300; ++round) {
    Interpolator interpolator;
    interpolator.renumber({7, -3, 1000});
    const uint16_t ticks = 1 + random() % 2000;
    int32_t rate[kAxes];
    int32_t acceleration[kAxes];
    for (uint8_t axis = 0; axis < kAxes; ++axis) {
      rate[axis] = any_rate(random);
      acceleration[axis] = (any_rate(random) / 2 - rate[axis] / 2) / ticks;
    }
    const QueueEnd start = interpolator.end();
    CHECK(push(interpolator, segment(ticks, rate, acceleration), true));
    int32_t stepped[kRails] = {7, -3};
    for (uint16_t n = 1; n <= ticks; ++n) {
      tick(interpolator, stepped);
      const SetPoint now = interpolator.set_point();
      for (uint8_t axis = 0; axis < kRails; ++axis) {
        const int64_t p = position_after(start.position[axis], rate[axis], acceleration[axis], n);
        CHECK_EQUAL(stepped[axis], whole_part(p));
        CHECK_EQUAL(now.rail_position[axis], whole_part(p));
        CHECK_EQUAL(interpolator.rail_phase(axis), phase_part(p));
      }
      CHECK_EQUAL(now.slide_position,
                  position_after(start.position[2], rate[2], acceleration[2], n));
    }
    CHECK(!interpolator.running());
  }
}

TEST(closed_form_is_the_sum) {
  int64_t p = 5, rate = -70;
  for (uint16_t n = 1; n < 3000; ++n) {
    p += rate;
    rate += 3;
    CHECK_EQUAL(position_after(5, -70, 3, n), p);
    CHECK_EQUAL(rate_after(-70, 3, n), rate);
  }
}

TEST(a_brake_brings_all_axes_to_rest_together_and_forwards) {
  Interpolator interpolator;
  interpolator.set_deceleration(kDeceleration);
  push(interpolator, segment(2000, {400000000, -90000000, 30000000}, {0, 0, 0}), false);
  int32_t stepped[kRails] = {};
  for (int i = 0; i < 100; ++i) tick(interpolator, stepped);
  const SetPoint before = interpolator.set_point();
  interpolator.brake();
  CHECK_EQUAL(interpolator.used(), 0);
  int32_t last[kRails] = {stepped[0], stepped[1]};
  int64_t last_slide = before.slide_position;
  int ticks = 0;
  while (interpolator.running() && ticks < 100000) {
    ++ticks;
    tick(interpolator, stepped);
    const SetPoint now = interpolator.set_point();
    CHECK(stepped[0] >= last[0] && stepped[1] <= last[1] && now.slide_position >= last_slide);
    last[0] = stepped[0];
    last[1] = stepped[1];
    last_slide = now.slide_position;
    for (uint8_t axis = 0; axis < kAxes && interpolator.running(); ++axis) {
      // as straight as before: the rates keep their proportions
      const double left = 1.0 - double(ticks) / 50001;
      CHECK(std::abs(now.rate[axis] - left * before.rate[axis]) < 50001);
    }
  }
  CHECK_EQUAL(ticks, 400000000 / 8000 + 1);
  // v^2 / 2 a
  CHECK(std::abs(stepped[0] - before.rail_position[0] - 400e6 * 50001 / 2 / 2147483648.0) < 2);
}

TEST(a_queue_that_runs_empty_in_motion_goes_on_until_braked) {
  Interpolator interpolator;
  interpolator.set_deceleration(kDeceleration);
  push(interpolator, segment(10, {1 << 30, 0, 0}, {0, 0, 0}), false);
  int32_t stepped[kRails] = {};
  for (int i = 0; i < 10; ++i) tick(interpolator, stepped);
  CHECK(interpolator.ran_empty());
  CHECK(!push(interpolator, segment(10, {1 << 30, 0, 0}, {0, 0, 0}), false));
  for (int i = 0; i < 10; ++i) tick(interpolator, stepped);
  CHECK_EQUAL(stepped[0], 10);  // half a step a tick, from the middle of a step
  interpolator.brake();
  CHECK(!interpolator.ran_empty());
  for (int i = 0; i < 200000 && interpolator.running(); ++i) tick(interpolator, stepped);
  CHECK(!interpolator.running());
  CHECK(stepped[0] > 10);
}

TEST(a_watched_switch_ends_the_steps_in_its_tick) {
  Interpolator interpolator;
  interpolator.switches().watch(0x82, 0x00);
  push(interpolator, segment(1000, {INT32_MAX, INT32_MAX, 0}, {0, 0, 0}), false);
  CHECK_EQUAL(interpolator.tick(0x01), 0x03);  // another bit of the port is none of its business
  CHECK_EQUAL(interpolator.tick(0x80), 0);
  CHECK(!interpolator.running());
  CHECK_EQUAL(interpolator.tick(0x00), 0);
  CHECK_EQUAL(interpolator.used(), 0);
  CHECK_EQUAL(interpolator.switches().take_tripped(), 0x80);
  CHECK_EQUAL(interpolator.switches().take_tripped(), 0);
  CHECK_EQUAL(interpolator.set_point().rail_position[0], 1);
}

TEST(sixteen_segments_fit_and_are_followed_in_order) {
  Interpolator interpolator;
  for (uint16_t i = 0; i < kQueueCapacity; ++i) {
    CHECK(interpolator.free_places() > 0);
    Segment next = segment(5, {0, 0, 0}, {0, 0, 0});
    next.number = i;
    push(interpolator, next, true);
  }
  CHECK_EQUAL(interpolator.free_places(), 0);
  for (uint16_t i = 0; i < kQueueCapacity * 5; ++i) {
    CHECK_EQUAL(interpolator.set_point().segment_number, i / 5);
    CHECK_EQUAL(interpolator.set_point().segment_tick, i % 5);
    CHECK_EQUAL(interpolator.used(), kQueueCapacity - i / 5);
    interpolator.tick(0);
  }
  CHECK(!interpolator.running());
}

TEST(a_trapezoid_arrives_and_keeps_its_rate) {
  std::mt19937 random(3);
  for (int round = 0; round < 60; ++round) {
    Interpolator interpolator;
    const int32_t longest = 1 + random() % 30000;
    const Trapezoid motion = {{longest, -longest / 3, longest / 7}, 644000000, 161000};
    CHECK(follow(interpolator, motion));
    int32_t stepped[kRails] = {};
    while (interpolator.running()) {
      tick(interpolator, stepped);
      CHECK(interpolator.set_point().rate[0] <= 644000000);
      CHECK(interpolator.set_point().rate[0] >= 0);
    }
    CHECK(!interpolator.ran_empty());
    CHECK_EQUAL(stepped[0], longest);
    CHECK(std::abs(stepped[1] + longest / 3) <= 1);
    CHECK(std::abs(whole_part(interpolator.set_point().slide_position) - longest / 7) <= 1);
  }
  Interpolator interpolator;
  CHECK(follow(interpolator, {{0, 0, 0}, 1000, 1}));
  CHECK(!interpolator.running());
  CHECK(!follow(interpolator, {{1000000, 0, 0}, 1, 1}));
}
