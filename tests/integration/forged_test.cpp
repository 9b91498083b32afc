// Messages in the name of others, to runs with real processes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "tests/integration/forger.hpp"
#include "tests/integration/lab_processes.hpp"

namespace hlc::test {
namespace {

using namespace std::chrono_literals;

void expect_forger_named(LabProcesses& lab) {
  for (const std::string& name : lab.names()) {
    EXPECT_EQ(lab[name].wait_for(1ms), 0) << name << ": " << lab.log(name);
    EXPECT_THAT(lab.log(name), testing::HasSubstr("messages of participant \"stranger\"")) << name;
  }
}

// Forged predictions collided cars, a minimal-risk stop in the lab control's name ended the run
// with exit code 0, and a command with a late stamp was the last that a car followed: without a
// line.
TEST(ForgedMessages, ChangeNothingAndTheirPublisherIsNamed) {
  LabProcesses undisturbed({.steps = 100});
  LabProcesses attacked({.steps = 100});
  const std::string expected = trace_of(undisturbed);
  {
    const Forger forger(attacked.lab_domain(), {1, 2, 3});
    EXPECT_EQ(trace_of(attacked), expected);
    EXPECT_GT(forger.num_rounds(), 10U);
  }
  EXPECT_NE(expected, "");
  expect_forger_named(attacked);
}

TEST(ForgedMessages, OfARunInRealTimeStopNoCar) {
  LabProcesses lab({.steps = 60, .simulated_time = false});
  const Forger forger(lab.lab_domain(), {1, 2, 3});
  lab.start_all();
  EXPECT_THAT(lab.still_running_after(120s), testing::IsEmpty());
  expect_forger_named(lab);
  EXPECT_EQ(lab.summarize(), 0) << lab.log("summarize");
}

}  // namespace
}  // namespace hlc::test
