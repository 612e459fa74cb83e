#include "options.hpp"

#include <stdexcept>

namespace rig {

Options::Options(int count, char** arguments) {
  for (int i = 1; i < count; ++i) {
    const std::string argument = arguments[i];
    const size_t equals = argument.find('=');
    if (equals == std::string::npos) {
      throw std::invalid_argument("expected name=value, got " + argument);
    }
    values_[argument.substr(0, equals)] = argument.substr(equals + 1);
  }
}

std::string Options::text(const std::string& name) const {
  const auto found = values_.find(name);
  if (found == values_.end()) throw std::invalid_argument("missing: " + name + "=...");
  return found->second;
}

double Options::number(const std::string& name) const {
  const std::string value = text(name);
  size_t used = 0;
  double number = 0;
  try {
    number = std::stod(value, &used);
  } catch (const std::exception&) {
    used = 0;
  }
  if (used == 0 || used != value.size()) {
    throw std::invalid_argument(name + " is not a number: " + value);
  }
  return number;
}

}  // namespace rig
