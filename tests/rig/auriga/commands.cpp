#include "commands.hpp"

#include <sstream>
#include <stdexcept>

#include "report.hpp"

namespace rig {
namespace {

[[noreturn]] void refuse(const std::string& what) { throw std::invalid_argument(what); }

// One of two words, true for the first.
bool choose(std::istringstream& words, const std::string& yes, const std::string& no) {
  std::string word;
  words >> word;
  if (word != yes && word != no) refuse("expected " + yes + " or " + no + ", got " + word);
  return word == yes;
}

void set_load(std::istringstream& words, Board& board) {
  Load load;
  load.force_n.clear();
  words >> load.first_mm >> load.spacing_mm;
  if (!words || load.spacing_mm <= 0) refuse("load: first position and spacing come first");
  for (double force_n = 0; words >> force_n;) load.force_n.push_back(force_n);
  if (load.force_n.empty() || !words.eof()) refuse("load: at least one force, numbers only");
  board.rho3.set_load(std::move(load));
}

void set_switch(std::istringstream& words, Board& board) {
  int axis = -1;
  words >> axis;
  Switch* limit_switch = board.limit_switch(axis);
  if (!words || limit_switch == nullptr) refuse("switch: the axis is 0, 1 or 2");
  std::string word;
  words >> word;
  if (word == "whole") {
    limit_switch->become(Switch::Health::WHOLE);
  } else if (word == "cut") {
    limit_switch->become(Switch::Health::CUT);
  } else if (word == "stuck") {
    limit_switch->become(Switch::Health::STUCK);
  } else {
    refuse("switch: whole, cut or stuck, not " + word);
  }
}

void set_link(std::istringstream& words, Board& board) {
  std::string word;
  words >> word;
  if (word == "cut" || word == "whole") {
    board.line.cut(word == "cut");
  } else if (word == "unplugged") {
    board.line.unplug();
  } else if (word == "plugged") {
    board.line.plug_in();
  } else {
    refuse("link: cut, whole, unplugged or plugged, not " + word);
  }
}

void set_faults(std::istringstream& words, Board& board) {
  LineFaults faults;
  words >> faults.lose >> faults.flip >> faults.duplicate >> faults.delay_s;
  if (!words) refuse("faults: four numbers");
  board.line.set_faults(faults);
}

void flip_eeprom(std::istringstream& words, Board& board) {
  unsigned address = 0;
  unsigned mask = 0;
  words >> address >> mask;
  if (!words || mask > 0xFF || !board.mcu.flip_eeprom(address, static_cast<uint8_t>(mask))) {
    refuse("eeprom: an address in it, and which bits to flip");
  }
}

void do_what(const std::string& verb, std::istringstream& words, Board& board) {
  if (verb == "load") {
    set_load(words, board);
  } else if (verb == "switch") {
    set_switch(words, board);
  } else if (verb == "stop_button") {
    board.power.stop_circuit().press(choose(words, "pressed", "released"));
  } else if (verb == "jam") {
    board.rho3.jam(choose(words, "on", "off"));
  } else if (verb == "encoder") {
    board.rho3.kill_encoder(choose(words, "dead", "alive"));
  } else if (verb == "reset") {
    choose(words, "button", "power") ? board.press_reset() : board.cycle_power();
  } else if (verb == "hang") {
    board.mcu.hang();
  } else if (verb == "link") {
    set_link(words, board);
  } else if (verb == "faults") {
    set_faults(words, board);
  } else if (verb == "eeprom") {
    flip_eeprom(words, board);
  } else if (verb == "record") {
    board.trace.record(choose(words, "on", "off"));
  } else {
    refuse("no such command: " + verb);
  }
}

}  // namespace

std::string obey(const std::string& line, Board& board, const Clock& clock) {
  std::istringstream words(line);
  std::string verb;
  words >> verb;
  if (verb == "statistics") return statistics_json(board);
  if (verb == "steps") return steps_json(board.trace);
  if (verb == "forget") {
    board.forget_statistics();
  } else if (verb != "state") {
    do_what(verb, words, board);
  }
  return state_json(board, clock);
}

}  // namespace rig
