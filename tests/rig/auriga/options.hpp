// The numbers of one run: name=value arguments of the command line.
#pragma once
#include <map>
#include <string>

namespace rig {

class Options {
 public:
  // Throws std::invalid_argument for anything that is not name=value.
  Options(int count, char** arguments);

  // Throw std::invalid_argument if it is missing or, for a number, is none.
  std::string text(const std::string& name) const;
  double number(const std::string& name) const;

 private:
  std::map<std::string, std::string> values_;
};

}  // namespace rig
