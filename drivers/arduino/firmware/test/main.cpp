// Runs all tests, or those whose names contain the argument.
#include <cstring>

#include "check.hpp"

int main(int count, char** arguments) {
  int run = 0;
  for (const check::Case& test : check::cases()) {
    if (count > 1 && std::strstr(test.name, arguments[1]) == nullptr) continue;
    const int before = check::failures();
    test.body();
    ++run;
    if (check::failures() != before) std::cout << "FAILED " << test.name << "\n";
  }
  std::cout << run << " tests, " << check::failures() << " failed checks\n";
  return check::failures() != 0 || run == 0;
}
