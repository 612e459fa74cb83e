// A test runner in one page: TEST defines a case, CHECK and CHECK_EQUAL judge.
#pragma once
#include <cstdint>
#include <iostream>
#include <string>
#include <vector>

namespace check {

struct Case {
  const char* name;
  void (*body)();
};

inline std::vector<Case>& cases() {
  static std::vector<Case> all;
  return all;
}

inline int& failures() {
  static int count = 0;
  return count;
}

struct Registration {
  Registration(const char* name, void (*body)()) { cases().push_back({name, body}); }
};

inline void judge(bool good, const char* file, int line, const std::string& what) {
  if (good) return;
  ++failures();
  std::cout << file << ":" << line << ": " << what << "\n";
}

// Every integer and enumeration of the firmware fits in here.
template <class Value>
int64_t number(Value value) {
  return static_cast<int64_t>(value);
}

template <class A, class B>
void judge_equal(A a, B b, const char* file, int line, const std::string& what) {
  if (number(a) == number(b)) return;
  judge(false, file, line,
        what + ": " + std::to_string(number(a)) + " != " + std::to_string(number(b)));
}

}  // namespace check

#define TEST(name)                                          \
  static void name();                                       \
  static const check::Registration registered_##name(#name, name); \
  static void name()

#define CHECK(condition) check::judge((condition), __FILE__, __LINE__, #condition)
#define CHECK_EQUAL(a, b) check::judge_equal((a), (b), __FILE__, __LINE__, #a " == " #b)
