// Runs with DDS security.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <string>
#include <utility>

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

/// Kinds of messages that an eavesdropper reads while the run is driven, and the trace.
std::pair<std::set<std::string>, std::string> read_during(LabProcesses& lab) {
  const Eavesdropper eavesdropper(lab.lab_domain(), {1, 2, 3});
  const std::string trace = trace_of(lab);
  std::set<std::string> kinds;
  for (const auto& [kind, count] : eavesdropper.num_read()) {
    if (count > 0) kinds.insert(kind);
  }
  return {kinds, trace};
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

// 12 kinds of messages are read of an open run, and none of a secured one; of the forger's 13 kinds
// none is received.
TEST(SecuredRun, IsTheSameWithAForgerOrAnEavesdropperAndWithoutSecurity) {
  const SecurityFolder security("1,2,3");
  LabProcesses open({.steps = 50});
  LabProcesses overheard({.steps = 50, .security = security.path().string()});
  LabProcesses attacked({.steps = 50, .security = security.path().string()});
  const auto [kinds, expected] = read_during(open);
  EXPECT_THAT(kinds, testing::UnorderedElementsAre(
                         "command to a middleware", "command to a vehicle", "parameter",
                         "prediction", "ready status", "report", "run state", "state", "state list",
                         "traffic", "trigger", "trigger to a controller"));
  EXPECT_EQ(read_during(overheard), (std::pair{std::set<std::string>{}, expected}));
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
