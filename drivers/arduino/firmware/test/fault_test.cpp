// What makes the board stop by itself and latch a fault, on a test stand.
#include "check.hpp"
#include "stand.hpp"

using namespace stand;
using protocol::Fault;
using protocol::Refusal;
using protocol::State;
using protocol::StopCategory;

TEST(a_switch_stops_the_steps_within_a_tick_and_unhomes) {
  Stand s;
  start_motion(s);
  s.cut = 2;
  const double before = s.place[0];
  s.run(5);
  CHECK(std::fabs(s.place[0] - before) <= 1);
  latched(s, Fault::LIMIT_SWITCH, true);
  CHECK_EQUAL(s.report().fault_detail, 2);
  CHECK(!homed(s));
  CHECK_EQUAL(s.board.clear_fault(), Refusal::NONE);  // homing is the way out
  CHECK_EQUAL(s.ramp(0, 0, 0), Refusal::NOT_HOMED);
}

TEST(a_silent_host_stops_the_robot) {
  Stand s;
  start_motion(s);
  for (int i = 0; i < 7; ++i) s.ramp(2000, -2000, 0);
  s.host_alive = false;
  s.run(protocol::HEARTBEAT_TIMEOUT_MS - 2);
  CHECK_EQUAL(s.board.fault(), Fault::NONE);
  s.run(3);
  latched(s, Fault::HEARTBEAT_LOST, false);
  Stand idle;
  idle.host_alive = false;
  idle.run(1000);
  CHECK_EQUAL(idle.board.state(), State::IDLE);
}

TEST(an_emergency_stop_latches_in_every_state) {
  Stand s;
  start_motion(s);
  s.board.emergency_stop(Fault::EMERGENCY_STOP);
  CHECK(s.report().commanded_rate[0] > 0);  // it decelerates
  CHECK_EQUAL(s.board.clear_fault(), Refusal::MOVING);
  latched(s, Fault::EMERGENCY_STOP, false);
  CHECK_EQUAL(s.board.clear_fault(), Refusal::NONE);
  CHECK_EQUAL(s.board.state(), State::IDLE);
  CHECK(homed(s));
  s.board.emergency_stop(Fault::SEGMENT_MISMATCH);
  latched(s, Fault::SEGMENT_MISMATCH, false);
  CHECK(!homed(s));
  Stand boot(false);
  boot.board.emergency_stop(Fault::NONE);
  latched(boot, Fault::EMERGENCY_STOP, false);
  CHECK_EQUAL(boot.board.clear_fault(), Refusal::NONE);
  CHECK_EQUAL(boot.board.state(), State::BOOT);
}

TEST(an_open_emergency_stop_circuit_latches_until_it_is_closed) {
  Stand s;
  start_motion(s);
  s.inputs.stop_circuit_open = true;
  s.run(1);
  CHECK_EQUAL(s.board.fault(), Fault::NONE);  // a spark
  s.run(1);
  latched(s, Fault::EMERGENCY_STOP, false);
  CHECK(s.report().flags & protocol::ESTOP_OPEN);
  CHECK(!homed(s));  // the button has cut the power of the motors
  CHECK_EQUAL(s.board.clear_fault(), Refusal::CAUSE_PRESENT);
  s.inputs.stop_circuit_open = false;
  s.run(1);
  CHECK_EQUAL(s.board.clear_fault(), Refusal::NONE);
}

TEST(a_fault_does_not_keep_the_host_from_configuring) {
  Stand s(false);
  s.inputs.stop_circuit_open = true;  // pressed when the power came
  s.run(30);
  CHECK_EQUAL(s.board.state(), State::FAULT);
  CHECK_EQUAL(s.board.configure(configuration()), Refusal::NONE);
  CHECK_EQUAL(s.board.state(), State::FAULT);
  s.inputs.stop_circuit_open = false;
  s.run(30);
  CHECK_EQUAL(s.board.clear_fault(), Refusal::NONE);
  CHECK_EQUAL(s.board.state(), State::IDLE);
}

// The slide sticks this far before its place, and no force limit is reached.
void stop_short(Stand& s, int32_t counts) {
  s.home();
  for (int i = 0; i < 5; ++i) s.ramp(0, 0, 400);
  s.ramp(0, 0, 0);
  const int32_t end = whole_part(s.board.interpolator().end().position[kSlide]);
  s.run_until([&] { return s.report().measured_rho3 >= end - counts; });
  s.jammed = true;
}

TEST(a_slide_that_stops_a_little_short_comes_to_rest_there) {
  Stand s;
  stop_short(s, 9);
  const int ms = s.run_until([&] { return !s.in(State::RUN); }, 2000);
  CHECK(ms >= protocol::ARRIVAL_STANDSTILL_MS);
  CHECK(ms < protocol::ARRIVAL_STANDSTILL_MS + 200);
  CHECK_EQUAL(s.board.state(), State::READY);
  CHECK(s.report().commanded[2] - s.report().measured_rho3 > 2);  // measured, not wished for
}

TEST(a_slide_that_stops_far_short_is_a_following_error) {
  Stand s;
  stop_short(s, 30);
  CHECK(s.run_until([&] { return !s.in(State::RUN); }, 2000) >= 0);
  latched(s, Fault::FOLLOWING_ERROR, true);
  CHECK_EQUAL(s.report().fault_detail, 4);
}

TEST(a_slide_that_stops_short_ends_homing) {
  Stand s;
  s.board.enable();
  s.board.home();
  s.run_until([&] { return s.report().commanded[2] == 100 && s.place[2] > 20; });
  s.jammed = true;
  CHECK(s.run_until([&] { return !s.in(State::HOMING); }, 5000) >= 0);
}

TEST(a_slide_that_passes_its_place_has_not_arrived) {
  Arrival arrival;
  protocol::ConfigRho3 numbers = {};
  numbers.settled = 2;
  numbers.near = 10;
  for (int32_t error = 40; error >= -40; --error) {
    CHECK_EQUAL(arrival.update(false, -error, error, numbers), Arrival::Answer::WAITING);
  }
  for (int ms = 1; ms < protocol::ARRIVED_MS; ++ms) arrival.update(false, -1, 1, numbers);
  CHECK_EQUAL(arrival.update(false, -1, 1, numbers), Arrival::Answer::WAITING);
  CHECK_EQUAL(arrival.update(false, -1, 1, numbers), Arrival::Answer::ARRIVED);
  CHECK_EQUAL(arrival.update(true, -1, 1, numbers), Arrival::Answer::WAITING);
  Arrival humming;
  Arrival::Answer answer = Arrival::Answer::WAITING;
  int ms = 0;
  for (; answer == Arrival::Answer::WAITING && ms < 10000; ++ms) {
    answer = humming.update(false, ms % 2, 20 + ms % 2, numbers);
  }
  CHECK_EQUAL(ms, protocol::ARRIVAL_TIMEOUT_MS);
  CHECK_EQUAL(answer, Arrival::Answer::MISSED);
}

TEST(a_jammed_slide_stalls_at_its_force_limit) {
  Stand s;
  s.home();
  CHECK_EQUAL(s.board.limit_force(0), Refusal::BAD_VALUE);
  CHECK_EQUAL(s.board.limit_force(1501), Refusal::BAD_VALUE);
  CHECK_EQUAL(s.board.limit_force(300), Refusal::NONE);
  s.jammed = true;
  for (int i = 0; i < 3; ++i) s.ramp(0, 0, 800);
  for (int i = 0; i < 3; ++i) s.ramp(0, 0, 0);
  int largest = 0;
  while (s.board.fault() == Fault::NONE) {
    s.millisecond();
    largest = std::max<int>(largest, s.report().force_dn);
    CHECK(s.report().force_dn <= 300);
  }
  CHECK(largest >= 295);
  latched(s, Fault::STALL, true);
  CHECK_EQUAL(s.report().commanded[2], s.report().measured_rho3);
}

// The slide on its way at 400 counts/s, with a low force limit.
void push_slowly(Stand& s) {
  s.home();
  s.board.limit_force(300);
  for (int i = 0; i < 14; ++i) s.ramp(0, 0, 400);
  s.ramp(0, 0, 0);
  s.run(60);
}

TEST(a_slide_that_pushes_itself_tight_still_knows_its_place) {
  Stand s;
  push_slowly(s);
  s.wall = s.place[kSlide] + 10;
  CHECK(s.run_until([&] { return s.in(State::FAULT); }, 2000) >= 0);
  latched(s, Fault::STALL, true);
  CHECK(homed(s));
}

TEST(a_stall_that_came_without_a_warning_unhomes) {
  Stand rigid;
  push_slowly(rigid);
  rigid.jammed = true;
  rigid.run_until([&] { return rigid.in(State::FAULT); }, 2000);
  latched(rigid, Fault::STALL, true);
  CHECK(!homed(rigid));
}

TEST(a_dead_encoder_unhomes) {
  for (const double rate : {400.0, -400.0, 1000.0}) {
    Stand s;
    s.home();
    for (int i = 0; i < 5; ++i) s.ramp(0, 0, 400);
    for (int i = 0; i < 9; ++i) s.ramp(0, 0, rate);
    s.ramp(0, 0, 0);
    s.run(160);
    s.encoder_dead = true;
    const double before = s.place[kSlide];
    CHECK(s.run_until([&] { return s.in(State::FAULT); }, 2000) >= 0);
    CHECK(std::fabs(s.place[kSlide] - before) > 20);  // it has gone on unseen
    CHECK(!homed(s));
    s.encoder_dead = false;
    CHECK(s.run_until([&] { return !s.board.moving(); }, 2000) >= 0);
    CHECK_EQUAL(s.board.clear_fault(), Refusal::NONE);
    CHECK_EQUAL(s.ramp(0, 0, 0), Refusal::NOT_HOMED);
    CHECK_EQUAL(s.board.home(), Refusal::NONE);
    CHECK(s.run_until([&] { return !s.in(State::HOMING); }) >= 0);
    CHECK(homed(s));
    CHECK(std::fabs(s.place[kSlide] - s.report().measured_rho3) <= 20);
  }
}

TEST(a_slide_that_is_dragged_away_is_a_following_error) {
  Stand s;
  start_motion(s);
  s.place[2] += 320;
  s.run(2);
  latched(s, Fault::FOLLOWING_ERROR, true);
  CHECK(!homed(s));
}

TEST(the_slide_follows_closely_and_settles) {
  Stand s;
  s.home();
  for (int i = 0; i < 10; ++i) s.ramp(0, 0, 1000);
  int32_t worst = 0;
  for (int i = 0; i < 150; ++i) {
    s.millisecond();
    worst = std::max(worst, std::abs(s.report().commanded[2] - s.report().measured_rho3));
  }
  CHECK(worst <= 25);  // behind a start five times as sharp as homing has
  for (int i = 0; i < 2; ++i) s.ramp(0, 0, 0);
  CHECK(s.run_until([&] { return s.in(State::READY); }, 500) >= 0);
}

TEST(the_first_fault_stays) {
  Stand s;
  start_motion(s);
  s.board.emergency_stop(Fault::EMERGENCY_STOP);
  s.cut = 1;
  s.run(10);
  latched(s, Fault::EMERGENCY_STOP, false);
  CHECK(!homed(s));
}

TEST(a_new_session_stops_what_moves) {
  Stand s;
  start_motion(s);
  s.board.begin_session();
  CHECK(s.run_until([&] { return s.in(State::READY); }, 300) >= 0);
  CHECK_EQUAL(s.report().next_segment, 0);
}
