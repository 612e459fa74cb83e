#include "report.hpp"

#include <cinttypes>
#include <cstdio>

namespace rig {
namespace {

// Room for the longest of the texts below, all numbers at their widest.
constexpr size_t kLongest = 1024;

// Nothing measured yet is 0.
double microseconds(uint64_t cycles) {
  return cycles == ~uint64_t{0} ? 0.0 : cycles * 1e6 / kCpuHz;
}

const char* truth(bool value) { return value ? "true" : "false"; }

std::string rail_json(const Rail& rail) {
  char text[kLongest];
  snprintf(text, sizeof text,
           "{\"steps\":%" PRIu64 ",\"lost\":%" PRIu64
           ",\"shortest_pulse_us\":%.4f,\"shortest_set_up_us\":%.4f,\"shortest_interval_us\":%.4f}",
           rail.steps(), rail.lost_steps(), microseconds(rail.shortest_pulse()),
           microseconds(rail.shortest_set_up()), microseconds(rail.shortest_interval()));
  return text;
}

}  // namespace

std::string state_json(Board& board, const Clock& clock) {
  char text[kLongest];
  const uint64_t now = board.mcu.now();
  snprintf(text, sizeof text,
           "{\"at_s\":%.6f,\"simulated_s\":%.7f,\"rho1_steps\":%" PRId64 ",\"rho2_steps\":%" PRId64
           ",\"rho3_mm\":%.6f,\"rho3_mm_s\":%.4f,\"load_n\":%.3f,\"pwm\":%d,\"power\":%s,"
           "\"relay\":%s,\"pressed\":[%s,%s,%s],\"resets\":%u}",
           clock.time_s(now), static_cast<double>(now) / kCpuHz, board.rho1.position(),
           board.rho2.position(), board.rho3.position_mm(), board.rho3.velocity_mm_s(),
           board.rho3.load_n(), board.rho3.pwm(), truth(board.power.on()),
           truth(board.power.relay()), truth(board.rho1.limit_switch().pressed()),
           truth(board.rho2.limit_switch().pressed()), truth(board.rho3.limit_switch().pressed()),
           board.mcu.resets());
  return text;
}

std::string statistics_json(const Board& board) {
  char text[kLongest];
  const TickWatch& ticks = board.ticks;
  const Damage& damage = board.line.damage();
  snprintf(text, sizeof text,
           "{\"ticks\":%" PRIu64 ",\"late_ticks\":%" PRIu64
           ",\"tick_interval_us\":[%.4f,%.4f],\"longest_tick_us\":%.4f,\"rounds\":%" PRIu64
           ",\"longest_round_us\":%.4f,\"tick_share\":%.4f,"
           "\"awake_share\":%.4f,\"overruns\":%" PRIu64 ",\"wrong_baud\":%" PRIu64
           ",\"bytes_to_board\":%" PRIu64 ",\"bytes_to_host\":%" PRIu64
           ",\"lost\":%" PRIu64 ",\"flipped\":%" PRIu64 ",\"duplicated\":%" PRIu64
           ",\"delayed\":%" PRIu64 ",\"rails\":[",
           ticks.ticks(), ticks.late_ticks(), microseconds(ticks.shortest_interval()),
           microseconds(ticks.longest_interval()), microseconds(ticks.longest_run()),
           ticks.rounds(), microseconds(ticks.longest_round()),
           ticks.tick_share(), ticks.awake_share(), board.uart.overruns(),
           board.line.wrong_baud(), board.line.bytes_to_board(), board.line.bytes_to_host(),
           damage.lost, damage.flipped, damage.duplicated, damage.delayed);
  return text + rail_json(board.rho1) + "," + rail_json(board.rho2) + "]}";
}

std::string steps_json(const StepTrace& trace) {
  std::string text = "{\"rails\":[";
  for (int axis = 0; axis < 2; ++axis) {
    text += axis == 0 ? "[" : "],[";
    for (const Step& step : trace.steps(axis)) {
      if (text.back() != '[') text += ',';
      text += "[" + std::to_string(step.cycle) + "," + std::to_string(step.tick) + "," +
              std::to_string(step.position) + "]";
    }
  }
  return text + "]]}";
}

// Enough for what is told here: no control characters, only quotes and backslashes.
std::string error_json(const std::string& words) {
  std::string quoted;
  for (const char c : words) {
    if (c == '"' || c == '\\') quoted += '\\';
    if (static_cast<unsigned char>(c) >= ' ') quoted += c;
  }
  return "{\"error\":\"" + quoted + "\"}";
}

}  // namespace rig
