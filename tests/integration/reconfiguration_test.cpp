// Controllers that are asked for another subgraph while they drive, by the program of the operator.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "hlc_bridge/messages/time_grid.hpp"
#include "hlc_bridge/time/real_time.hpp"
#include "tests/integration/fault_rules.hpp"
#include "tests/integration/lab_processes.hpp"
#include "tests/integration/run_reports.hpp"
#include "tests/support/folders.hpp"

namespace hlc::test {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;

constexpr auto kPatience = 60s;

class Reconfiguration : public testing::Test {
 protected:
  explicit Reconfiguration(const std::string& scenario = "on_request",
                           const std::string& policy = "")
      : lab_({.scenario = scenario, .policy = policy, .steps = 1000, .simulated_time = false}) {
    lab_.start_all();
  }

  void SetUp() override {
    ASSERT_TRUE(eventually(kPatience, [&] { return planned_steps(lab_.reports(), {2}) >= 15; }))
        << lab_.log("lab_control");
  }

  struct Asked {
    int code{};
    std::string output;
  };
  /// Runs the operator's program to its end.
  [[nodiscard]] Asked ask(const std::vector<std::string>& flags) const {
    std::vector<std::string> command{build_folder() + "/bin/automaton_request",
                                     "--dds_domain=" + std::to_string(lab_.lab_domain()),
                                     "--transport=loopback"};
    command.insert(command.end(), flags.begin(), flags.end());
    const std::filesystem::path log = lab_.folder() / "automaton_request.log";
    ChildProcess program(command, log);
    const std::optional<int> code = program.wait_for(kPatience);
    return {code.value_or(-1), read_text(log)};
  }

  /// Fastest of a vehicle in the second before now.
  [[nodiscard]] double top_speed_mps(std::uint8_t vehicle) const {
    const Nanoseconds now = time::real_time_now();
    double top_mps = 0.0;
    const result::Drives drives = lab_.drives();
    for (const result::DrivenSample& sample : drives.at(vehicle)) {
      if (sample.t + kNanosecondsPerSecond > now) top_mps = std::max(top_mps, sample.speed_mps);
    }
    return top_mps;
  }

  void expect_good_end() {
    lab_["lab_control"].send(SIGINT);
    EXPECT_THAT(lab_.still_running_after(kPatience), testing::IsEmpty());
    expect_nobody_was_touched(lab_);
  }

  LabProcesses lab_;
};

TEST_F(Reconfiguration, ASpeedLimitHoldsForTheVehicleThatIsAskedUntilTheScenariosOwnIsAskedFor) {
  // The paper's automaton drives straight on at 0.8 m/s alone: a lower limit leaves few ways.
  const Asked slow = ask({"--vehicle_ids=2", "--max_speed_mps=0.7"});
  EXPECT_EQ(slow.code, 0) << slow.output;
  EXPECT_THAT(slow.output, HasSubstr("vehicle 2: in force from step"));
  EXPECT_THAT(slow.output, HasSubstr("B, at most 0.7 m/s"));
  EXPECT_THAT(lab_.log("high_level_controller_2"),
              HasSubstr("planning on subgraph B, at most 0.7"));
  constexpr double kBetween_mps = 0.76;  // of the trims' 0.7 and 0.8 m/s
  EXPECT_TRUE(eventually(
      kPatience,
      [&] { return top_speed_mps(2) < kBetween_mps && top_speed_mps(1) > kBetween_mps; }))
      << "vehicle 2 at " << top_speed_mps(2) << " m/s, vehicle 1 at " << top_speed_mps(1);

  const Asked own = ask({"--vehicle_ids=2"});
  EXPECT_EQ(own.code, 0) << own.output;
  EXPECT_TRUE(eventually(kPatience, [&] { return top_speed_mps(2) > kBetween_mps; }));
  expect_good_end();
}

TEST_F(Reconfiguration, AllAreAskedForAnotherLabelFromATimeOn) {
  const Asked asked = ask({"--criteria=J3", "--in_s=1"});
  EXPECT_EQ(asked.code, 0) << asked.output;
  for (const char* vehicle : {"1", "2", "3"}) {
    const std::string name = std::string("vehicle ") + vehicle;
    EXPECT_THAT(asked.output, HasSubstr(name + ": accepted: B, label J3"));
    EXPECT_THAT(asked.output, HasSubstr(name + ": in force from step"));
  }
  expect_good_end();
}

TEST_F(Reconfiguration, NewWeightsAreSolvedBesideTheRunAndDrivenOn) {
  const Asked asked = ask({"--vehicle_ids=2", "--weights=J2=0.1,J1=0.9"});
  EXPECT_EQ(asked.code, 0) << asked.output;
  EXPECT_THAT(asked.output, HasSubstr("vehicle 2: in force from step"));
  EXPECT_THAT(asked.output, HasSubstr("B, weights J1 0.9 J2 0.1"));
  const StepIndex after{time::real_time_now() / kNanosecondsPerSecond * 5};
  EXPECT_TRUE(
      eventually(kPatience, [&] { return planned_steps(lab_.reports(), {2}, after) >= 10; }));
  EXPECT_TRUE(eventually(kPatience, [&] {
    return std::ranges::any_of(lab_.reports(), [](const ReportRecord& record) {
      return record.report.vehicle == VehicleId{2} && record.report.maneuver == "J1 0.9 J2 0.1" &&
             record.report.subgraph == "B, weights J1 0.9 J2 0.1";
    });
  })) << "the records name the new maneuvers";
  const Asked unknown = ask({"--vehicle_ids=2", "--weights=J1=0.3,J9=0.7"});
  EXPECT_EQ(unknown.code, 1) << unknown.output;
  EXPECT_THAT(unknown.output,
              HasSubstr("vehicle 2: refused: weights: criterion 'J9', must be one of J1"));
  EXPECT_EQ(ask({"--vehicle_ids=2", "--weights=J1:0.3"}).code, 2);
  EXPECT_EQ(ask({"--vehicle_ids=2", "--weights=J1=0.3", "--criteria=J2"}).code, 2);
  expect_good_end();
}

TEST_F(Reconfiguration, WhatCannotBeIsRefusedAndTheCarDrivesOn) {
  const Asked refused = ask({"--vehicle_ids=2", "--max_speed_mps=0.1"});
  EXPECT_EQ(refused.code, 1) << refused.output;
  EXPECT_THAT(refused.output, HasSubstr("vehicle 2: refused: speed limit 0.1 m/s, must be >= 0.4"));
  EXPECT_EQ(ask({"--vehicle_ids=2", "--criteria=J9"}).code, 1);
  EXPECT_EQ(ask({"--vehicle_ids=2", "--disable_edges=1-2"}).code, 2);
  EXPECT_EQ(ask({"--vehicle_ids=2,2"}).code, 2);
  const Asked unanswered = ask({"--vehicle_ids=7", "--timeout_s=1"});
  EXPECT_EQ(unanswered.code, 3);
  EXPECT_THAT(unanswered.output, HasSubstr("high_level_controller_7"));
  const StepIndex after{time::real_time_now() / kNanosecondsPerSecond * 5};
  EXPECT_TRUE(
      eventually(kPatience, [&] { return planned_steps(lab_.reports(), {2}, after) >= 5; }));
  expect_good_end();
}

class ReconfigurationInAZone : public Reconfiguration {
 protected:
  ReconfigurationInAZone() : Reconfiguration("reconfiguration", "zone") {}

  /// Vehicle 2 has planned on that subgraph since then.
  [[nodiscard]] bool has_planned_on(const std::string& subgraph, StepIndex since) const {
    const std::vector<ReportRecord> records = lab_.reports();
    return std::ranges::any_of(records, [&](const ReportRecord& record) {
      const coordination::Report& report = record.report;
      return report.vehicle == VehicleId{2} && report.step >= since &&
             report.status == coordination::StepStatus::kPlanned && report.subgraph == subgraph;
    });
  }
};

TEST_F(ReconfigurationInAZone, TheZonesLimitIsLaidOnWhatTheOperatorAsksFor) {
  const auto drives_in_and_out = [&](const std::string& asked, StepIndex since) {
    return eventually(kPatience, [&] {
      return has_planned_on(asked, since) && has_planned_on(asked + ", at most 0.6 m/s", since);
    });
  };
  EXPECT_TRUE(drives_in_and_out("J2", {}));
  const Asked comfort = ask({"--vehicle_ids=2", "--criteria=comfort"});
  EXPECT_EQ(comfort.code, 0) << comfort.output;
  const StepIndex since{time::real_time_now() / kNanosecondsPerSecond * 5};
  EXPECT_TRUE(drives_in_and_out("J2, label comfort", since));
  const Asked own = ask({"--vehicle_ids=2"});
  EXPECT_EQ(own.code, 0) << own.output;
  EXPECT_TRUE(drives_in_and_out("J2", {time::real_time_now() / kNanosecondsPerSecond * 5 + 2}));
  expect_good_end();
}

}  // namespace
}  // namespace hlc::test
