// All processes with cars like the lab's: their controller, its errors, poses 20 ms ahead of their
// stamps.
#include <gtest/gtest.h>

#include <algorithm>

#include "hlc_bridge/messages/node_names.hpp"
#include "tests/simulation/observed_run.hpp"

namespace hlc::closed_loop::lab_vehicle_test {
namespace {

using coordination::FallbackReason;

constexpr Nanoseconds kPatience = 120 * kNanosecondsPerSecond;
constexpr std::size_t kSteps = 75;
const std::string kLeadLine = "ms ahead of their stamps";

struct Case {
  std::string scenario;
  bool is_logical{};
  friend void PrintTo(const Case& one, std::ostream* out) {
    *out << one.scenario << (one.is_logical ? "_logical" : "_real");
  }
};

class LabVehicle : public testing::TestWithParam<Case> {};

/// Steps of an experiment of 15 s, of all cars.
void drive(ObservedRun& run) {
  const std::size_t all = kSteps * run.scenario().vehicles.size();
  ASSERT_TRUE(run.comes_to(
      [&] {
        return static_cast<std::size_t>(
                   std::ranges::count_if(run.reports(), [](const ReportRecord& record) {
                     return record.report.status != coordination::StepStatus::kStandby;
                   })) >= all;
      },
      kPatience));
}

TEST_P(LabVehicle, UndisturbedItIsNoDisturbance) {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    const scenario::Scenario& scenario = scenario_of(GetParam().scenario);
    ObservedRun run(scenario, {.seed = seed, .is_logical = GetParam().is_logical, .steps = kSteps});
    drive(run);
    for (const ReportRecord& record : run.reports()) {
      for (const FallbackReason reason :
           {FallbackReason::kDeviation, FallbackReason::kConflict, FallbackReason::kUndrivable}) {
        EXPECT_NE(record.report.reason, reason)
            << to_string(reason) << ", seed " << seed << ", vehicle "
            << int{record.report.vehicle.value} << ", step " << record.report.step.value;
      }
    }
    for (const scenario::ScenarioVehicle& vehicle : scenario.vehicles) {
      EXPECT_FALSE(run.has_logged(controller_name(vehicle.id.value), kLeadLine));
    }
    EXPECT_EQ(run.violations(), "");
  }
}

INSTANTIATE_TEST_SUITE_P(Scenarios, LabVehicle,
                         testing::Values(Case{"lab_red_alone", true}, Case{"lab_red_alone", false},
                                         Case{"lab_three_cars", true},
                                         Case{"lab_three_cars", false}, Case{"lab_circle", true},
                                         Case{"lab_circle", false}, Case{"lab_ring", true}),
                         testing::PrintToStringParamName());

TEST(PoseLead, IsEstimatedWhereTheLabsDescriptionIsWrong) {
  for (const double described_s : {0.010, 0.016, 0.024, 0.030}) {
    scenario::Scenario red = scenario_of("lab_red_alone");
    red.lab->pose_lead_s = described_s;
    ObservedRun run(red, {.seed = 1, .is_logical = true, .steps = kSteps});
    drive(run);
    const bool is_wrong =
        std::abs(described_s - 1e-9 * static_cast<double>(kVehiclePeriod)) > 0.005;
    EXPECT_EQ(run.has_logged(controller_name(1), kLeadLine), is_wrong) << described_s;
  }
}

}  // namespace
}  // namespace hlc::closed_loop::lab_vehicle_test
