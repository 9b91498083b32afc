// Cars among a guest that does what it likes.
#include <gtest/gtest.h>

#include <optional>
#include <string>

#include "hlc_bridge/result/run_description.hpp"
#include "hlc_bridge/result/run_summary.hpp"
#include "planner/scenario/starts.hpp"
#include "tests/support/folders.hpp"
#include "tests/support/num_seeds.hpp"
#include "vehicle_sim/closed_loop/experiment.hpp"

namespace hlc::closed_loop::guest_test {
namespace {

scenario::Scenario lab_guest(std::size_t cars) {
  return scenario::read_scenario(
      {.file = test::source_folder() + "/launch_scripts/scenarios/lab_guest.yaml", .cars = cars});
}

result::RunSummary driven(const scenario::Scenario& scenario, const ExperimentOptions& options) {
  const Experiment experiment = drive_experiment(scenario, options);
  const std::vector<result::StepRecord> rows =
      result::step_records(experiment.reports, experiment.drives, experiment.facts);
  return result::summarize(result::describe(scenario, options.noise_seed), experiment.facts, rows,
                           experiment.drives);
}

TEST(AmongAGuest, NoMovingCarTouchesItWhateverItDoes) {
  double nearest_m = 1.0;
  for (const std::size_t cars : {3U, 10U}) {
    const scenario::Scenario scenario = lab_guest(cars);
    for (std::uint64_t seed = 1; seed <= test::num_costly_seeds(2); ++seed) {
      SCOPED_TRACE(std::to_string(cars) + " cars, seed " + std::to_string(seed));
      const std::optional<std::uint64_t> noise = seed % 2 == 0 ? std::optional(seed) : std::nullopt;
      const result::RunSummary summary =
          driven(scenario::with_random_starts(scenario, seed), {.steps = 100, .noise_seed = noise});
      EXPECT_EQ(summary.collisions, 0U);
      ASSERT_TRUE(summary.with_guests.min_distance_m);
      nearest_m = std::min(nearest_m, *summary.with_guests.min_distance_m);
    }
  }
  EXPECT_LT(nearest_m, 0.1) << "it was never near";
}

TEST(AmongAGuest, TheSameRunComesOfTheSameSeed) {
  const scenario::Scenario scenario = lab_guest(4);
  EXPECT_EQ(driven(scenario, {.steps = 60}).trace_sha256,
            driven(scenario, {.steps = 60}).trace_sha256);
}

}  // namespace
}  // namespace hlc::closed_loop::guest_test
