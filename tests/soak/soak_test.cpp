// The short form: a few runs of each kind.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "tests/support/program.hpp"

namespace hlc::test {
namespace {

TEST(Soak, RandomFaultsLeaveNoCollisionNobodyRunningAndNothingBehind) {
  const Outcome outcome = run_program("soak faults --runs 2 --seed 1 --keep");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
}

TEST(Soak, StartsAndStopsLeaveNobodyRunningAndNothingBehind) {
  const Outcome outcome = run_program("soak cycles --runs 5 --keep");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
}

TEST(Soak, AnUndisturbedRunInRealTimeIsComplete) {
  const Outcome outcome = run_program("soak undisturbed --runs 1 --steps 15 --keep");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
}

TEST(Soak, RefusesBadFlagsInOneLine) {
  for (const char* flags :
       {"", "faults", "faults --runs 0", "faults --runs -1", "cycles --runs x",
        "faults --runs 1 --steps 3", "faults --runs 1 --transport radio", "storms --runs 1"}) {
    const Outcome outcome = run_program(std::string("soak ") + flags);
    EXPECT_EQ(outcome.exit_code, 2) << flags;
    EXPECT_EQ(std::ranges::count(outcome.output, '\n'), 1) << outcome.output;
  }
}

}  // namespace
}  // namespace hlc::test
