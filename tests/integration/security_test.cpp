// Runs with DDS security.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <string>

#include "tests/integration/eavesdropper.hpp"
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

/// Kinds of messages that an eavesdropper reads while the run is driven.
std::set<std::string> kinds_read_during(LabProcesses& lab, std::string& trace) {
  const Eavesdropper eavesdropper(lab.lab_domain(), {1, 2, 3});
  trace = trace_of(lab);
  std::set<std::string> kinds;
  for (const auto& [kind, count] : eavesdropper.num_read()) {
    if (count > 0) kinds.insert(kind);
  }
  return kinds;
}

// Of the forger's 13 kinds of messages none is received: no line about one of them.
TEST(SecuredRun, IsTheSameWithAForgerAndAnEavesdropperAndWithoutSecurity) {
  const SecurityFolder security("1,2,3");
  LabProcesses open({.steps = 50});
  LabProcesses secured({.steps = 50, .security = security.path().string()});
  std::string expected;
  EXPECT_THAT(kinds_read_during(open, expected),
              testing::IsSupersetOf({"command to a middleware", "command to a vehicle", "log",
                                     "prediction", "ready status", "report", "run state", "state",
                                     "state list", "traffic", "trigger"}));
  {
    const Forger forger(secured.lab_domain(), {1, 2, 3});
    std::string trace;
    EXPECT_THAT(kinds_read_during(secured, trace), testing::IsEmpty());
    EXPECT_EQ(trace, expected);
  }
  EXPECT_NE(expected, "");
  expect_success(secured);
  for (const std::string& name : secured.names()) {
    EXPECT_THAT(secured.log(name),
                testing::Not(testing::HasSubstr("messages of participant \"stranger\"")))
        << name;
    EXPECT_TRUE(name.starts_with("vehicle") ||
                testing::Value(secured.log(name),
                               testing::ContainsRegex("participant \"stranger\" .* refused")))
        << name;
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
