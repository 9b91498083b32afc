// Runs in real time, driven again from their messages: the controllers of runs in memory, whose
// messages are recorded as the processes of a lab record them.
#include "vehicle_sim/closed_loop/recorded_run.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "hlc_bridge/messages/node_names.hpp"
#include "hlc_bridge/result/first_difference.hpp"
#include "tests/simulation/observed_run.hpp"
#include "tests/support/num_seeds.hpp"

namespace hlc::closed_loop::recorded_run_test {
namespace {

constexpr Nanoseconds kSecond = kNanosecondsPerSecond;

/// Records what is published in a run.
class Recorder {
 public:
  explicit Recorder(ObservedRun& run) : run_(run) {
    run.record([this](const std::string& process, const Message& message) {
      if (const auto* const list = std::get_if<VehicleStateList>(&message)) take(process, *list);
      if (const auto* const one = std::get_if<coordination::Traffic>(&message)) {
        take(*one, messages_.traffic);
      }
      if (const auto* const one = std::get_if<coordination::Prediction>(&message)) {
        take(*one, messages_.predictions);
      }
      if (const auto* const one = std::get_if<coordination::Outcome>(&message)) {
        take(*one, messages_.outcomes);
      }
    });
  }
  [[nodiscard]] const RecordedMessages& messages() const { return messages_; }

 private:
  void take(const std::string& process, const VehicleStateList& list) {
    const StepIndex step{list.t_now / (kSecond / 5)};
    for (const scenario::ScenarioVehicle& vehicle : run_.scenario().vehicles) {
      if (process != middleware_name(vehicle.id.value)) continue;
      messages_.lists.try_emplace({vehicle.id, step}, list);
    }
  }
  template <class Published>
  void take(const Published& message, RecordedMessages::BySteps<Published>& messages) {
    messages.emplace(message.step, RecordedMessages::Published<Published>{
                                       run_.now(), std::make_shared<Published>(message)});
  }

  ObservedRun& run_;
  RecordedMessages messages_;
};

std::vector<ReportRecord> reports_of(VehicleId vehicle, const ObservedRun& run) {
  std::vector<ReportRecord> reports;
  std::ranges::copy_if(run.reports(), std::back_inserter(reports),
                       [&](const ReportRecord& one) { return one.report.vehicle == vehicle; });
  return reports;
}

std::vector<result::StepRecord> rows_of(const std::vector<ReportRecord>& reports) {
  std::vector<result::StepRecord> rows;
  for (const ReportRecord& one : reports) {
    rows.push_back({.step = one.report.step.value, .record = one, .driven = {}});
  }
  return rows;
}

/// Where the run driven again begins to differ; empty: nowhere.
std::string difference_of(VehicleId vehicle, const ObservedRun& run,
                          const RecordedMessages& messages) {
  const controller::PreparedSubgraph prepared = scenario::prepare_subgraph_of(run.scenario());
  const std::vector<ReportRecord> recorded = reports_of(vehicle, run);
  const std::vector<ReportRecord> again =
      drive_recorded(run.scenario(), prepared, vehicle, messages, recorded);
  EXPECT_EQ(again.size(), recorded.size());
  const auto difference = result::first_difference(rows_of(recorded), rows_of(again));
  return difference ? result::text_of(*difference, 0.2) : "";
}

class RecordedRun : public testing::TestWithParam<std::string> {};

TEST_P(RecordedRun, IsTheSameAgainForEveryController) {
  const scenario::Scenario& scenario = scenario_of(GetParam());
  for (std::uint64_t seed = 1; seed <= test::num_costly_seeds(5); ++seed) {
    SCOPED_TRACE(seed);
    ObservedRun run(scenario, {.seed = seed, .transport = Transport::kLoopback});
    Recorder recorder(run);
    run.pass(12 * kSecond);
    for (const scenario::ScenarioVehicle& vehicle : scenario.vehicles) {
      EXPECT_GT(reports_of(vehicle.id, run).size(), 30U);
      EXPECT_EQ(difference_of(vehicle.id, run, recorder.messages()), "");
    }
  }
}

TEST_P(RecordedRun, IsTheSameAgainIfTrafficIsLostAndAControllerIsFrozen) {
  const scenario::Scenario& scenario = scenario_of(GetParam());
  for (std::uint64_t seed = 1; seed <= test::num_costly_seeds(5); ++seed) {
    SCOPED_TRACE(seed);
    ObservedRun run(scenario, {.seed = seed, .transport = Transport::kLoopback});
    Recorder recorder(run);
    run.pass(8 * kSecond);
    run.freeze(controller_name(2));
    run.pass(kSecond / 2);
    run.resume(controller_name(2));
    run.pass(4 * kSecond);
    for (const VehicleId vehicle : {VehicleId{1}, VehicleId{3}}) {
      EXPECT_EQ(difference_of(vehicle, run, recorder.messages()), "");
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Scenarios, RecordedRun,
                         testing::Values("paper_three_cars", "lab_three_cars"),
                         [](const auto& tested) { return tested.param; });

TEST(RecordedRunOf, AMissingListEndsThere) {
  const scenario::Scenario& scenario = scenario_of("paper_three_cars");
  ObservedRun run(scenario, {.seed = 7, .transport = Transport::kLoopback});
  Recorder recorder(run);
  run.pass(8 * kSecond);
  RecordedMessages messages = recorder.messages();
  const std::vector<ReportRecord> recorded = reports_of({1}, run);
  messages.lists.erase({VehicleId{1}, recorded[10].report.step});
  EXPECT_EQ(
      drive_recorded(scenario, scenario::prepare_subgraph_of(scenario), {1}, messages, recorded)
          .size(),
      10U);
}

TEST(RecordedRunOf, AnotherStateInAListIsSeen) {
  const scenario::Scenario& scenario = scenario_of("paper_three_cars");
  ObservedRun run(scenario, {.seed = 7, .transport = Transport::kLoopback});
  Recorder recorder(run);
  run.pass(10 * kSecond);
  RecordedMessages messages = recorder.messages();
  const std::vector<ReportRecord> recorded = reports_of({1}, run);
  const StepIndex at = recorded[recorded.size() - 5].report.step;
  for (VehicleState& state : messages.lists.at({VehicleId{1}, at}).states) {
    if (state.vehicle_id == 1) state.pose.x_m += 0.004;
  }
  EXPECT_NE(difference_of({1}, run, messages), "");
}

}  // namespace
}  // namespace hlc::closed_loop::recorded_run_test
