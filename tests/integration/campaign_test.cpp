// The same run with processes over DDS and within one process.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ostream>

#include <nlohmann/json.hpp>

#include "hlc_bridge/result/run_description.hpp"
#include "hlc_bridge/result/run_summary.hpp"
#include "tests/integration/lab_processes.hpp"
#include "tests/support/folders.hpp"
#include "vehicle_sim/closed_loop/experiment.hpp"

namespace hlc::test {
namespace {

using namespace std::chrono_literals;

struct Same {
  std::string scenario;
  std::string profile;
  std::optional<std::uint64_t> noise_seed;
  std::string policy{};
  int steps{40};
  std::optional<std::size_t> cars{};
};
void PrintTo(const Same& one, std::ostream* out) {
  *out << one.scenario << "_" << one.profile << (one.policy.empty() ? "" : "_") << one.policy
       << (one.noise_seed ? "_with_noise" : "");
}

class SameRun : public testing::TestWithParam<Same> {};

std::string trace_with_processes(const Same& same, int steps) {
  LabProcesses lab({.scenario = same.scenario,
                    .profile = same.profile,
                    .cars = same.cars,
                    .policy = same.policy,
                    .steps = steps,
                    .noise_seed = same.noise_seed});
  lab.start_all();
  EXPECT_THAT(lab.still_running_after(120s), testing::IsEmpty());
  EXPECT_EQ(lab.summarize(), 0) << lab.log("summarize");
  return nlohmann::json::parse(read_text(lab.folder() / "summary.json")).at("trace_sha256");
}

TEST_P(SameRun, WithProcessesAndWithinOneProcessGivesTheSamePosesToTheLastBit) {
  const int steps = GetParam().steps;
  const scenario::Scenario scenario = scenario::read_scenario(
      {.file = test::source_folder() + "/launch_scripts/scenarios/" + GetParam().scenario + ".yaml",
       .profile = GetParam().profile,
       .policy = GetParam().policy.empty() ? std::nullopt : std::optional(GetParam().policy),
       .cars = GetParam().cars});
  const closed_loop::ExperimentOptions options{.steps = static_cast<std::uint64_t>(steps),
                                               .noise_seed = GetParam().noise_seed};
  const closed_loop::Experiment experiment = closed_loop::drive_experiment(scenario, options);
  const std::vector<result::StepRecord> rows =
      result::step_records(experiment.reports, experiment.drives, experiment.facts);
  EXPECT_EQ(rows.size(), static_cast<std::size_t>(steps) * scenario.vehicles.size());
  const std::string trace = result::summarize(result::describe(scenario, options.noise_seed),
                                              experiment.facts, rows, experiment.drives)
                                .trace_sha256;
  EXPECT_EQ(trace_with_processes(GetParam(), steps), trace);
}

INSTANTIATE_TEST_SUITE_P(
    Campaign, SameRun,
    testing::Values(Same{"paper_three_cars", "default", std::nullopt},
                    Same{"paper_three_cars", "2022", 7}, Same{"circle", "default", 3},
                    Same{"reconfiguration", "default", 5, "", 115},
                    Same{"reconfiguration", "2022", std::nullopt, "zone_look_ahead"},
                    Same{"lab_cars", "default", 2, "", 40, 4}),
    testing::PrintToStringParamName());

}  // namespace
}  // namespace hlc::test
