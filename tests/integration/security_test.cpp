// Runs with DDS security.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "tests/integration/forger.hpp"
#include "tests/integration/lab_processes.hpp"
#include "tests/support/security_folder.hpp"

namespace hlc::test {
namespace {

using namespace std::chrono_literals;

void expect_success(LabProcesses& lab) {
  for (const std::string& name : lab.names()) {
    EXPECT_EQ(lab[name].wait_for(1ms), 0) << name << ": " << lab.log(name);
  }
}

// Of the forger's 13 kinds of messages none is received: no line about it.
TEST(SecuredRun, IsTheSameWithAStrangerAndWithoutSecurity) {
  const SecurityFolder security("1,2,3");
  LabProcesses open({.steps = 50});
  LabProcesses secured({.steps = 50, .security = security.path().string()});
  const std::string expected = trace_of(open);
  {
    const Forger forger(secured.lab_domain(), {1, 2, 3});
    EXPECT_EQ(trace_of(secured), expected);
  }
  EXPECT_NE(expected, "");
  expect_success(secured);
  for (const std::string& name : secured.names()) {
    EXPECT_THAT(secured.log(name), testing::Not(testing::HasSubstr("stranger"))) << name;
  }
}

TEST(SecuredRun, DrivesInRealTime) {
  const SecurityFolder security("1,2,3");
  LabProcesses lab({.steps = 40, .simulated_time = false, .security = security.path().string()});
  lab.start_all();
  EXPECT_THAT(lab.still_running_after(120s), testing::IsEmpty());
  expect_success(lab);
}

// It would drive among others that it cannot trust.
TEST(SecuredRun, DoesNotBeginWithAProcessThatHasNoIdentity) {
  const SecurityFolder security("1,2");
  LabProcesses lab({.steps = 10, .security = security.path().string()});
  lab.start("high_level_controller_3");
  EXPECT_EQ(lab["high_level_controller_3"].wait_for(60s), 2);
  EXPECT_THAT(lab.log("high_level_controller_3"),
              testing::HasSubstr("high_level_controller_3/certificate.pem: no such file"));
}

}  // namespace
}  // namespace hlc::test
