#include "vehicle_sim/campaign/run_series.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "hlc_bridge/result/run_record.hpp"
#include "planner/common/csv.hpp"
#include "planner/common/text_file.hpp"
#include "tests/support/folders.hpp"
#include "tests/support/temporary_folder.hpp"

namespace hlc::campaign::run_series_test {
namespace {

constexpr std::size_t kSteps = 15;

std::string without_line_feed(std::string text) {
  text.pop_back();
  return text;
}

/// Rows with their heading, read back.
CsvTable table_of(const char* columns, const std::string& rows) {
  const test::TemporaryFolder folder;
  write_file(folder / "rows.csv", columns + rows);
  return {folder / "rows.csv", without_line_feed(columns)};
}

class RunSeriesTest : public testing::Test {
 protected:
  explicit RunSeriesTest(const std::string& scenario = "paper_three_cars",
                         std::vector<std::string> policies = {})
      : campaign_({.scenarios = {test::source_folder() + "/launch_scripts/scenarios/" + scenario +
                                 ".yaml"},
                   .profiles = {"default"},
                   .subgraphs = {},
                   .policies = std::move(policies),
                   .steps = kSteps}),
        run_(campaign_.drive(campaign_.runs().size() - 1,
                             {.cpu = [this] { return now_ += 50'000; }})) {}

  [[nodiscard]] RunSeries series(SeriesExtent extent = SeriesExtent::kWhole) const {
    return series_of(run_, 7, campaign_.heading_of(0), extent);
  }

  Nanoseconds now_{};
  Campaign campaign_;
  DrivenRun run_;
};

TEST_F(RunSeriesTest, StepsHaveARowPerStepAndVehicleAndAgreeWithTheSummary) {
  const CsvTable steps = table_of(kStepColumns, series().steps);
  const std::vector<result::VehicleSummary> vehicles = campaign_.result_of(run_).summary.vehicles;
  ASSERT_EQ(steps.size(), kSteps * vehicles.size());
  const auto column = [&](const char* name) { return steps.find(name).value(); };
  for (const result::VehicleSummary& vehicle : vehicles) {
    double error_sum_mm = 0.0;
    double generated_max = 0.0;
    double planning_sum_ms = 0.0;
    std::set<std::uint64_t> numbers;
    for (std::size_t row = 0; row < steps.size(); ++row) {
      EXPECT_EQ(steps.unsigned_number(row, column("run")), 7U);
      if (steps.unsigned_number(row, column("vehicle")) != vehicle.id.value) continue;
      EXPECT_EQ(steps.text(row, column("name")), vehicle.name);
      EXPECT_EQ(steps.text(row, column("is_stuck")), "false");
      numbers.insert(steps.unsigned_number(row, column("step")));
      error_sum_mm += steps.number(row, column("error_mm"));
      generated_max = std::max(generated_max, steps.number(row, column("generated")));
      if (steps.text(row, column("searched")) == "true") {
        planning_sum_ms += steps.number(row, column("planning_ms"));
      }
    }
    EXPECT_EQ(numbers.size(), kSteps);
    EXPECT_NEAR(error_sum_mm / kSteps, 1e3 * vehicle.reference_error_m->mean, 1e-9);
    EXPECT_EQ(generated_max, vehicle.generated->max);
    EXPECT_NEAR(planning_sum_ms,
                1e3 * vehicle.planning_s->mean * static_cast<double>(vehicle.planning_s->count),
                1e-9);
  }
}

TEST_F(RunSeriesTest, DrivesHaveEveryTickOfTheStepsAndEndWhereTheCarDoes) {
  const CsvTable drives = table_of(kDriveColumns, series().drives);
  const auto column = [&](const char* name) { return drives.find(name).value(); };
  std::size_t rows_of_all = 0;
  for (const auto& [id, drive] : run_.experiment.drives) {
    std::vector<std::size_t> own;
    for (std::size_t row = 0; row < drives.size(); ++row) {
      if (drives.unsigned_number(row, column("vehicle")) == id) own.push_back(row);
    }
    ASSERT_FALSE(own.empty());
    EXPECT_EQ(drives.number(own.front(), column("time_s")), 0.0);
    const double period_s = 1e-9 * static_cast<double>(run_.experiment.facts.period);
    EXPECT_NEAR(drives.number(own.back(), column("time_s")), kSteps * period_s, 1e-9);
    const result::RunFacts& facts = run_.experiment.facts;
    const std::optional<Pose> end =
        result::driven_pose_at(drive, (facts.first_step.value() + kSteps) * facts.period);
    ASSERT_TRUE(end);
    EXPECT_NEAR(drives.number(own.back(), column("x_m")), end->x_m, 5.1e-5);
    EXPECT_NEAR(drives.number(own.back(), column("y_m")), end->y_m, 5.1e-5);
    EXPECT_EQ(drives.text(own.back(), column("zone_limit_mps")), "");
    rows_of_all += own.size();
  }
  EXPECT_EQ(rows_of_all, drives.size());
}

TEST_F(RunSeriesTest, DistancesHaveTheSmallestOfTheSummary) {
  const CsvTable distances = table_of(kDistanceColumns, series().distances);
  const auto column = [&](const char* name) { return distances.find(name).value(); };
  ASSERT_GT(distances.size(), 0U);
  double least_m = kNear_m;
  for (std::size_t row = 0; row < distances.size(); ++row) {
    least_m = std::min(least_m, distances.number(row, column("distance_m")));
    EXPECT_LT(distances.number(row, column("distance_m")), kNear_m);
    EXPECT_LT(distances.unsigned_number(row, column("first")),
              distances.unsigned_number(row, column("second")));
    EXPECT_EQ(distances.number(row, column("kept_m")),
              2.0 * run_.scenario.subgraph->automaton().vehicle.safety_margin_m);
  }
  EXPECT_NEAR(least_m, campaign_.result_of(run_).summary.min_footprint_distance_m.value(), 1e-4);
}

TEST_F(RunSeriesTest, OfOtherStartsTheFirstVehicleIsWrittenWithoutPlanningTimes) {
  const RunSeries sparse = series(SeriesExtent::kFirstVehicle);
  EXPECT_EQ(sparse.distances, "");
  const CsvTable steps = table_of(kStepColumns, sparse.steps);
  ASSERT_EQ(steps.size(), kSteps);
  for (std::size_t row = 0; row < steps.size(); ++row) {
    EXPECT_EQ(steps.unsigned_number(row, steps.find("vehicle").value()),
              run_.scenario.vehicles.front().id.value);
    EXPECT_EQ(steps.text(row, steps.find("planning_ms").value()), "");
  }
  const RunSeries whole = series();
  const auto lines = [](const std::string& text) { return std::ranges::count(text, '\n'); };
  const auto ticks = lines(whole.drives) / std::ssize(run_.scenario.vehicles);
  EXPECT_EQ(lines(sparse.drives), (ticks + std::ptrdiff_t{kSparse} - 1) / std::ptrdiff_t{kSparse});
}

// As if the last vehicle had waited since before the run.
TEST_F(RunSeriesTest, ACarThatWaitsForSoLongIsStuck) {
  for (ReportRecord& record : run_.experiment.reports) {
    coordination::Report& report = record.report;
    if (report.vehicle != run_.scenario.vehicles.back().id) continue;
    report.waiting = {.vehicles = {run_.scenario.vehicles.front().id}, .since = StepIndex{}};
    report.step.value += 1000;
  }
  run_.experiment.facts.first_step = 1000 + run_.experiment.facts.first_step.value();
  const CsvTable steps = table_of(kStepColumns, series().steps);
  const std::size_t stuck = steps.find("is_stuck").value();
  std::size_t count = 0;
  for (std::size_t row = 0; row < steps.size(); ++row) {
    count += steps.text(row, stuck) == "true" ? 1U : 0U;
  }
  EXPECT_EQ(count, kSteps);
}

class RunSeriesInZones : public RunSeriesTest {
 protected:
  RunSeriesInZones() : RunSeriesTest("reconfiguration", {"zone"}) {}
};

TEST_F(RunSeriesInZones, DrivesHaveTheLimitWhereACarIsInAZone) {
  const CsvTable drives = table_of(kDriveColumns, series().drives);
  const std::size_t limit = drives.find("zone_limit_mps").value();
  std::set<std::string> limits;
  for (std::size_t row = 0; row < drives.size(); ++row) limits.insert(drives.text(row, limit));
  EXPECT_EQ(limits, (std::set<std::string>{"", "0.6"}));
}

}  // namespace
}  // namespace hlc::campaign::run_series_test
