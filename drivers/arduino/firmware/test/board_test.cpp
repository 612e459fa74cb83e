// States, refusals and stops of the board, on a test stand.
#include <cstring>

#include "../core/kept_configuration.hpp"
#include "../core/thermistor.hpp"
#include "check.hpp"
#include "stand.hpp"

using namespace stand;
using protocol::Fault;
using protocol::Refusal;
using protocol::State;
using protocol::StopCategory;

TEST(without_a_configuration_nothing_is_possible) {
  Stand s(false);
  s.run(5);
  CHECK_EQUAL(s.board.state(), State::BOOT);
  CHECK_EQUAL(s.board.enable(), Refusal::NOT_CONFIGURED);
  CHECK_EQUAL(s.board.home(), Refusal::NOT_CONFIGURED);
  CHECK_EQUAL(s.board.limit_force(10), Refusal::NOT_CONFIGURED);
  CHECK_EQUAL(s.board.configure(configuration()), Refusal::NONE);
  CHECK_EQUAL(s.board.state(), State::IDLE);
}

TEST(drives_go_on_and_off) {
  Stand s;
  CHECK_EQUAL(s.board.home(), Refusal::DRIVES_OFF);
  CHECK_EQUAL(s.board.enable(), Refusal::NONE);
  s.run(2);
  CHECK(s.outputs.drives_on);
  CHECK_EQUAL(s.board.configure(configuration()), Refusal::NOT_AT_REST);
  CHECK_EQUAL(s.ramp(100, 0, 0), Refusal::NOT_HOMED);
  CHECK_EQUAL(s.board.disable(), Refusal::NONE);
  s.run(2);
  CHECK(!s.outputs.drives_on);
  CHECK_EQUAL(s.outputs.pwm, 0);
  CHECK_EQUAL(s.board.state(), State::IDLE);
}

TEST(with_the_drives_off_the_slide_stands_where_it_is_measured) {
  Stand s;
  s.run(5);
  const int32_t before = s.report().commanded[2];
  s.place[2] += 70;  // turned by hand
  s.run(30);
  CHECK_EQUAL(s.report().commanded[2], before + 70);
  s.board.enable();
  s.run(20);
  CHECK_EQUAL(s.outputs.pwm, 0);
}

TEST(the_place_before_a_loss_of_power_is_remembered) {
  Stand s(false);
  s.board.remember({11, 22, 33});
  CHECK_EQUAL(s.board.configure(configuration()), Refusal::NONE);
  s.run(2);
  CHECK_EQUAL(s.report().commanded[1], 22);
  CHECK_EQUAL(s.report().measured_rho3, 33);
  Stand unknown;
  unknown.run(2);
  CHECK_EQUAL(unknown.report().commanded[0], 4000);
  CHECK_EQUAL(unknown.report().measured_rho3, 100);
}

TEST(homing_finds_the_true_places) {
  Stand s;
  s.place[0] += 130;  // the board remembers other places than the true ones
  s.place[1] -= 90;
  s.place[2] += 40;
  s.home();
  CHECK_EQUAL(s.board.state(), State::READY);
  CHECK(homed(s));
  const protocol::Telemetry t = s.report();
  for (int axis = 0; axis < 2; ++axis) {
    CHECK(std::abs(t.commanded[axis] - 4000) <= 1);
    CHECK(std::fabs(s.place[axis] - t.commanded[axis]) <= 2);
  }
  CHECK(std::abs(t.measured_rho3 - 100) <= 2);
  CHECK(std::fabs(s.place[2] - t.measured_rho3) <= 3);
  protocol::Event event;
  CHECK(s.board.take_event(event));
  CHECK_EQUAL(event.kind, protocol::EventKind::HOMING_DONE);
}

TEST(carriages_keep_their_distance_while_one_seeks) {
  Stand s;
  s.board.enable();
  s.board.home();
  bool slide_was_back = false;
  while (s.in(State::HOMING)) {
    s.millisecond();
    slide_was_back = slide_was_back || s.place[2] < -50;
    if (s.place[0] != 4000) CHECK(slide_was_back);
    CHECK(std::fabs(s.place[0] + s.place[1] - 8000) <= 2);
  }
}

TEST(homing_fails_with_a_cut_wire_or_a_dead_switch) {
  for (uint8_t axis = 0; axis < kAxes; ++axis) {
    Stand cut;
    cut.cut = 1 << axis;
    cut.home();
    latched(cut, Fault::HOMING_FAILED, true);
    CHECK_EQUAL(cut.report().fault_detail, 1 << axis);
    CHECK(!homed(cut));
  }
  Stand far;
  far.place[0] += 15000;  // further than the travel and what is beyond it
  far.home();
  latched(far, Fault::HOMING_FAILED, true);
  CHECK_EQUAL(far.report().fault_detail, 1);
}

TEST(segments_are_followed_to_their_end) {
  Stand s;
  s.home();
  const int32_t before = s.report().commanded[0];
  CHECK_EQUAL(s.ramp(2000, -1000, 500), Refusal::NONE);
  CHECK_EQUAL(s.ramp(2000, -1000, 500), Refusal::NONE);
  CHECK_EQUAL(s.ramp(0, 0, 0), Refusal::NONE);
  CHECK_EQUAL(s.board.state(), State::RUN);
  CHECK(s.run_until([&] { return s.in(State::READY); }, 1000) >= 55);
  CHECK(std::abs(s.report().commanded[0] - before - 80) <= 1);
  CHECK(std::fabs(s.place[2] - s.report().commanded[2]) <= 4);
  CHECK_EQUAL(s.report().next_segment, 3);
  CHECK_EQUAL(s.report().segment, 3);
}

TEST(segments_that_do_not_fit_are_refused_and_change_nothing) {
  Stand s;
  s.home();
  const int32_t still[kAxes] = {};
  const auto refusal = [&](auto spoil) {
    protocol::Segment message = s.segment(still, still);
    spoil(message);
    return s.board.push(message);
  };
  CHECK_EQUAL(refusal([](auto& m) { ++m.number; }), Refusal::WRONG_NUMBER);
  CHECK_EQUAL(refusal([](auto& m) { m.ticks = 0; }), Refusal::BAD_TICKS);
  CHECK_EQUAL(refusal([](auto& m) { m.ticks = 2001; }), Refusal::BAD_TICKS);
  CHECK_EQUAL(refusal([](auto& m) { m.phase[1] = 1U << 31; }), Refusal::BAD_VALUE);
  CHECK_EQUAL(refusal([](auto& m) { ++m.start[2]; }), Refusal::DISCONTINUOUS);
  CHECK_EQUAL(refusal([](auto& m) { m.rate[0] = rate_of(60); }), Refusal::RATE_JUMP);
  CHECK_EQUAL(refusal([](auto& m) { m.acceleration[0] = rate_of(9001) / 399; }), Refusal::TOO_FAST);
  CHECK_EQUAL(refusal([](auto& m) {
                m.ticks = 2000;
                m.acceleration[2] = -rate_of(1399) / 1999;
              }),
              Refusal::NONE);
  Stand t;
  t.home();
  protocol::Segment out = t.segment(still, still);
  out.ticks = 2000;
  out.acceleration[2] = -rate_of(1399) / 1999;
  CHECK_EQUAL(t.board.push(out), Refusal::NONE);
  protocol::Segment further = t.segment({0, 0, t.board.interpolator().end().rate[2]}, still);
  further.ticks = 2000;
  CHECK_EQUAL(t.board.push(further), Refusal::BEYOND_TRAVEL);
  further.ticks = 100;
  ++further.phase[0];
  CHECK_EQUAL(t.board.push(further), Refusal::DISCONTINUOUS);
}

TEST(the_lights_can_change_before_anything_moves) {
  Stand s;
  s.home();
  s.run(20);
  CHECK(s.outputs.lights_may_change);
  const double before = s.place[0];
  for (int i = 0; i < 6; ++i) s.ramp(2000, 0, 0);
  CHECK_EQUAL(s.board.state(), State::RUN);
  s.millisecond();
  CHECK(s.outputs.lights_may_change);
  CHECK_EQUAL(s.place[0], before);
  CHECK_EQUAL(s.report().segment, 0);  // it has begun, though nothing of it is done
  CHECK_EQUAL(s.report().segment_tick, 0);
  s.run(10);
  CHECK(!s.outputs.lights_may_change);
  CHECK(s.place[0] > before);
}

TEST(a_motion_waits_for_what_was_lost_on_its_way) {
  Stand s;
  s.home();
  const double before = s.place[0];
  s.ramp(2000, 0, 0);
  s.run(60);  // the second segment is sent again
  CHECK_EQUAL(s.board.state(), State::RUN);
  CHECK_EQUAL(s.place[0], before);
  s.ramp(0, 0, 0);  // ends at rest: nothing more is needed
  s.run(10);
  CHECK(s.place[0] > before);
  CHECK(s.run_until([&] { return s.in(State::READY); }, 500) >= 0);
}

TEST(a_motion_does_not_wait_for_ever) {
  Stand s;
  s.home();
  s.ramp(2000, 0, 0);
  CHECK(s.run_until([&] { return s.board.state() == State::FAULT; }, 200) > 100);
  latched(s, Fault::QUEUE_UNDERRUN, true);
}

TEST(a_stop_before_the_first_step_drops_the_queue) {
  Stand s;
  s.home();
  const protocol::Telemetry before = s.report();
  for (int i = 0; i < 3; ++i) s.ramp(2000, 0, 1000);
  s.board.stop(StopCategory::DECELERATE_AND_HOLD);
  CHECK(s.run_until([&] { return s.in(State::READY); }, 100) >= 0);
  CHECK_EQUAL(s.report().commanded[0], before.commanded[0]);
  CHECK_EQUAL(s.report().commanded[2], s.report().measured_rho3);
  CHECK_EQUAL(s.report().queue_used, 0);
  CHECK_EQUAL(s.ramp(100, 0, 0), Refusal::NONE);
}

TEST(at_rest_the_phase_is_taken_over) {
  Stand s;
  s.home();
  const int32_t still[kAxes] = {};
  protocol::Segment message = s.segment(still, still);
  message.phase[0] = 12345;
  CHECK_EQUAL(s.board.push(message), Refusal::NONE);
  CHECK_EQUAL(phase_part(s.board.interpolator().end().position[0]), 12345);
}

TEST(a_full_queue_refuses) {
  Stand s;
  s.home();
  for (int i = 0; i < protocol::QUEUE_CAPACITY; ++i) CHECK_EQUAL(s.ramp(0, 0, 0), Refusal::NONE);
  CHECK_EQUAL(s.ramp(0, 0, 0), Refusal::QUEUE_FULL);
  CHECK_EQUAL(s.report().queue_used, protocol::QUEUE_CAPACITY);
}

TEST(a_stop_holds_or_releases) {
  for (const bool release : {false, true}) {
    Stand s;
    start_motion(s);
    s.board.stop(release ? StopCategory::DECELERATE_AND_RELEASE : StopCategory::DECELERATE_AND_HOLD);
    CHECK_EQUAL(s.board.state(), State::STOPPING);
    CHECK_EQUAL(s.ramp(0, 0, 0), Refusal::STOPPING);
    CHECK_EQUAL(s.board.disable(), Refusal::MOVING);
    CHECK(s.run_until([&] { return !s.board.moving(); }, 200) > 10);
    CHECK_EQUAL(s.board.state(), release ? State::IDLE : State::READY);
    CHECK(homed(s));
    CHECK(std::fabs(s.place[0] - s.report().commanded[0]) <= 2);
    CHECK_EQUAL(s.report().commanded[2], s.report().measured_rho3);
  }
}

TEST(after_a_stop_a_blocked_slide_is_let_go) {
  Stand s;
  s.home();
  for (int i = 0; i < 8; ++i) s.ramp(0, 0, 1000);
  s.run(60);
  s.jammed = true;
  s.run(20);
  s.board.stop(StopCategory::DECELERATE_AND_HOLD);
  CHECK(s.run_until([&] { return s.in(State::READY); }, 300) >= 0);
  s.run(2);
  CHECK_EQUAL(s.report().commanded[2], s.report().measured_rho3);
  CHECK(std::abs(s.outputs.pwm) < 20);
}

TEST(an_empty_queue_in_motion_is_an_underrun) {
  Stand s;
  s.home();
  s.ramp(2000, 0, 0);
  s.run(30);
  latched(s, Fault::QUEUE_UNDERRUN, true);
  CHECK(homed(s));
  CHECK_EQUAL(s.ramp(0, 0, 0), Refusal::FAULT_LATCHED);
  CHECK_EQUAL(s.board.clear_fault(), Refusal::NONE);
  CHECK_EQUAL(s.board.state(), State::READY);
  CHECK_EQUAL(s.ramp(100, 0, 0), Refusal::NONE);
}

TEST(unsound_configurations_are_refused) {
  CHECK(configuration().is_sound());
  const auto sound_with = [](auto spoil) {
    Configuration c = configuration();
    spoil(c);
    return c.is_sound();
  };
  CHECK(!sound_with([](auto& c) { c.axis[0].stop_deceleration = 0; }));
  CHECK(!sound_with([](auto& c) { c.axis[1].max_rate = 1U << 31; }));
  CHECK(!sound_with([](auto& c) { c.axis[2].axis = 1; }));
  CHECK(!sound_with([](auto& c) { c.axis[2].travel_min = 6000; }));
  CHECK(!sound_with([](auto& c) { c.rho3.pwm_per_newton_q8 = 0; }));
  CHECK(!sound_with([](auto& c) { c.rho3.force_limit_dn = 2000; }));
  CHECK(!sound_with([](auto& c) { c.rho3.near = 1; }));
  CHECK(!sound_with([](auto& c) { c.axis[2].travel_max = 1 << 24; }));  // 2^-8 counts overflow
}

TEST(a_damaged_configuration_in_the_eeprom_is_noticed) {
  const KeptConfiguration kept = KeptConfiguration::of(configuration());
  CHECK(kept.is_of_this_protocol() && kept.is_whole() && !kept.is_blank());
  for (size_t bit = 0; bit < 8 * sizeof kept; ++bit) {
    KeptConfiguration damaged = kept;
    reinterpret_cast<uint8_t*>(&damaged)[bit / 8] ^= 1 << bit % 8;
    CHECK(!damaged.is_of_this_protocol() || !damaged.is_whole());
  }
  KeptConfiguration erased;
  std::memset(&erased, 0xFF, sizeof erased);
  CHECK(erased.is_blank() && !erased.is_whole());
  Stand s(false);
  s.board.miss_kept_configuration();
  CHECK(s.report().flags & protocol::KEPT_DAMAGED);
}

TEST(temperature_and_supply_are_told) {
  CHECK_EQUAL(temperature_dc(512), 250);
  for (uint16_t value = 0; value < 1024; ++value) {
    // B = 3380 K, 10 kOhm at 25 degC
    const double ohm = 10000.0 * std::fmax(value, 0.1) / (1024 - value);
    const double truth = 1 / (std::log(ohm / 10000) / 3380 + 1 / 298.15) - 273.15;
    if (truth > 0 && truth < 60) CHECK(std::fabs(temperature_dc(value) / 10.0 - truth) < 1);
  }
  CHECK_EQUAL(supply_mv(1023), 14985);
  Stand s;
  CHECK_EQUAL(s.report().supply_mv, 0);
  CHECK_EQUAL(s.report().temperature_dc, INT16_MIN);
  s.inputs.supply_mv = 12100;
  s.inputs.temperature_dc = 312;
  s.run(1);
  CHECK_EQUAL(s.report().supply_mv, 12100);
  CHECK_EQUAL(s.report().temperature_dc, 312);
}
