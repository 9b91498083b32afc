// Runs with DDS security.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

#include "tests/integration/eavesdropper.hpp"
#include "tests/integration/forger.hpp"
#include "tests/integration/lab_processes.hpp"
#include "tests/support/child_process.hpp"
#include "tests/support/security_folder.hpp"

namespace hlc::test {
namespace {

using namespace std::chrono_literals;

void expect_success(LabProcesses& lab) {
  for (const std::string& name : lab.names()) {
    EXPECT_EQ(lab[name].wait_for(1ms), 0) << name << ": " << lab.log(name);
  }
}

/// Kinds of messages that have been read.
std::set<std::string> kinds_of(const Eavesdropper& eavesdropper) {
  std::set<std::string> kinds;
  for (const auto& [kind, count] : eavesdropper.num_read()) {
    if (count > 0) kinds.insert(kind);
  }
  return kinds;
}

void expect_nothing_of_forger_received(LabProcesses& lab) {
  for (const std::string& name : lab.names()) {
    const std::string log = lab.log(name);
    EXPECT_THAT(log, testing::Not(testing::HasSubstr("messages of participant \"stranger\"")))
        << name;
    if (name.starts_with("vehicle")) continue;  // it logs nothing of others
    EXPECT_THAT(log, testing::ContainsRegex("participant \"stranger\" .* refused")) << name;
  }
}

// What the next test relies on.
TEST(OpenRun, IsReadByAnEavesdropper) {
  LabProcesses lab({.steps = 50});
  const Eavesdropper eavesdropper(lab.lab_domain(), {1, 2, 3});
  lab.start_all();
  const std::set<std::string> expected{"command to a middleware",
                                       "command to a vehicle",
                                       "parameter",
                                       "prediction",
                                       "ready status",
                                       "report",
                                       "run state",
                                       "state",
                                       "state list",
                                       "traffic",
                                       "trigger",
                                       "trigger to a controller"};
  EXPECT_TRUE(eventually(60s, [&] {
    return std::ranges::includes(kinds_of(eavesdropper), expected);
  })) << testing::PrintToString(kinds_of(eavesdropper));
  static_cast<void>(lab.still_running_after(60s));
}

// None of 15 kinds of messages is read; of the forger's 13 kinds none is received.
TEST(SecuredRun, IsTheSameWithAForgerOrAnEavesdropperAndWithoutSecurity) {
  const SecurityFolder security("1,2,3");
  LabProcesses open({.steps = 50});
  LabProcesses overheard({.steps = 50, .security = security.path().string()});
  LabProcesses attacked({.steps = 50, .security = security.path().string()});
  const std::string expected = trace_of(open);
  {
    const Eavesdropper eavesdropper(overheard.lab_domain(), {1, 2, 3});
    EXPECT_EQ(trace_of(overheard), expected);
    EXPECT_THAT(kinds_of(eavesdropper), testing::IsEmpty());
  }
  {
    const Forger forger(attacked.lab_domain(), {1, 2, 3});
    EXPECT_EQ(trace_of(attacked), expected);
  }
  EXPECT_NE(expected, "");
  expect_success(overheard);
  expect_success(attacked);
  expect_nothing_of_forger_received(attacked);
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
