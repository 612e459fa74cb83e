// The firmware: everything is wired together here, and only here.
#include <avr/interrupt.h>
#include <avr/sleep.h>
#include <avr/wdt.h>

#include "actuators.hpp"
#include "buzzer.hpp"
#include "gauges.hpp"
#include "light_ring.hpp"
#include "machine.hpp"
#include "reset_record.hpp"
#include "step_timer.hpp"
#include "store.hpp"
#include "uart.hpp"

namespace plugpilot {

Board board;
Link link(board, uart::to_send);

namespace {

using protocol::Fault;

constexpr uint8_t kBytesPerJob = 32;

void wake_up() {
  int32_t place[kAxes];
  if (store::load_place(place)) board.remember(place);
  Configuration configuration;
  const store::Kept kept = store::load_configuration(configuration);
  if (kept == store::Kept::WHOLE) board.configure(configuration);
  if (kept == store::Kept::DAMAGED) board.miss_kept_configuration();
}

void introduce() {
  const protocol::ResetCause cause = reset_record::cause();
  const bool hung = cause == protocol::ResetCause::WATCHDOG;
  Fault before = reset_record::fault_before();
  if (before == Fault::NONE) before = hung ? Fault::WATCHDOG : store::load_fault();
  link.introduce({store::count_boot(), cause, before});
  if (hung) board.start_with_fault(Fault::WATCHDOG);
}

void keep_fault() {
  static Fault kept = Fault::NONE;
  if (board.fault() == kept) return;
  kept = board.fault();
  reset_record::keep(kept);
  store::save_fault(kept);
}

// Only where the robot comes to rest: the EEPROM wears out.
void keep_place() {
  static bool was_moving = false;
  if (was_moving && !board.moving()) {
    const SetPoint now = board.interpolator().set_point();
    const int32_t place[kAxes] = {now.rail_position[0], now.rail_position[1],
                                  whole_part(now.slide_position)};
    store::save_place(place);
  }
  was_moving = board.moving();
}

void receive() {
  for (uint8_t left = kBytesPerJob; left > 0 && !uart::received.empty(); --left) {
    if (link.receive(uart::received.take())) return;
  }
}

// Between two rounds of the closed loop only one of these: a flood of frames must not starve it.
void do_short_job() {
  if (!link.tell()) receive();
  uart::kick();
  store::step();
}

void every_millisecond() {
  gauges::every_millisecond();
  Inputs inputs = actuators::read();
  gauges::read(inputs);
  const Outputs outputs = board.every_millisecond(inputs);
  actuators::apply(outputs);
  if (step_timer::take_late_tick()) link.note_late_tick();
  if (uart::take_overrun()) link.note_overrun();
  link.every_millisecond();
  if (link.take_save_request()) store::save_configuration(board.config());
  keep_fault();
  keep_place();
  buzzer::every_millisecond(board.fault());
  if (outputs.lights_may_change) light_ring::show(board.state());
}

// Until the next interrupt, unless one has left work behind.
void sleep_if_idle(uint8_t beat_done) {
  cli();
  if (uart::received.empty() && board.interpolator().clock().beat() == beat_done) {
    sleep_enable();
    sei();
    sleep_cpu();
    sleep_disable();
  }
  sei();
}

void start() {
  actuators::start();
  light_ring::start();
  buzzer::start();
  gauges::start();
  uart::start();
  wake_up();
  introduce();
  reset_record::keep(board.fault());
  step_timer::start();
  set_sleep_mode(SLEEP_MODE_IDLE);
  wdt_enable(WDTO_250MS);
  sei();
}

void run() {
  uint8_t beat_done = board.interpolator().clock().beat();
  for (;;) {
    if (board.interpolator().clock().beat() != beat_done) {
      ++beat_done;
      every_millisecond();
      // reached only if the ticks go on and this loop has come round
      wdt_reset();
    }
    do_short_job();
    sleep_if_idle(beat_done);
  }
}

}  // namespace
}  // namespace plugpilot

int main() {
  plugpilot::start();
  plugpilot::run();
}
