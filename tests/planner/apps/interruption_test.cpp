#include "planner/apps/interruption.hpp"

#include <gtest/gtest.h>

#include <csignal>

namespace hlc::apps {
namespace {

TEST(InterruptionDeathTest, EndsWithItsCodeAndNamesHowToGoOn) {
  const auto interrupt = [] {
    const Interruption interruption("evaluate", "the same command goes on");
    std::raise(SIGINT);
  };
  EXPECT_EXIT(interrupt(), testing::ExitedWithCode(130),
              "^evaluate: interrupted; the same command goes on\n$");
}

TEST(InterruptionDeathTest, AfterItASignalEndsAsUsual) {
  const auto interrupt = [] {
    { const Interruption interruption("evaluate", "the same command goes on"); }
    std::raise(SIGINT);
  };
  EXPECT_EXIT(interrupt(), testing::KilledBySignal(SIGINT), "^$");
}

}  // namespace
}  // namespace hlc::apps
