// The main of tests that drive in real time. A virtual machine may stand still for seconds when its
// host takes the processors away: then all processes have fallen silent to each other at once, and
// a test's observations are meaningless. A test that failed while the machine stood still is
// therefore run again; one that failed while it ran has failed.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <iostream>
#include <string>
#include <vector>

#include "tests/support/standstill_watch.hpp"

namespace {

constexpr int kMostTries = 3;
constexpr const char* kTryVariable = "HLC_TEST_TRY";

int tries_so_far() {
  const char* const text = std::getenv(kTryVariable);
  return text == nullptr ? 1 : std::max(1, std::atoi(text));
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<char*> arguments(argv, argv + argc);  // GoogleTest takes its own out
  arguments.push_back(nullptr);
  testing::InitGoogleTest(&argc, argv);
  hlc::test::StandstillWatch watch;
  const int code = RUN_ALL_TESTS();
  const std::chrono::duration<double> longest = watch.end();
  const int tried = tries_so_far();
  if (code == 0 || longest < hlc::test::kStandstill || tried == kMostTries) return code;
  std::cout << "the machine stood still for " << longest.count() << " s meanwhile: run again, "
            << tried + 1 << " of " << kMostTries << std::endl;
  setenv(kTryVariable, std::to_string(tried + 1).c_str(), 1);
  execv("/proc/self/exe", arguments.data());
  return code;
}
