// Another subgraph between two control steps, with the real controller and search.
#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <memory>
#include <string>

#include "planner/controller/command_time.hpp"
#include "planner/maneuver_design/automaton_builder.hpp"
#include "planner/rollout/rollout.hpp"
#include "planner/scenario/scenario.hpp"
#include "tests/support/folders.hpp"

namespace hlc::scenario::switching_test {
namespace {

const std::string kFolder = test::source_folder() + "/launch_scripts/";
const std::uint64_t kDrivableSteps = controller::drivable_steps(8, 0.2);  // of the paper's scenario

/// The red car alone without lane bounds, on an automaton with all labels, and its subgraphs.
class Switching : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    const maneuver_design::AutomatonConfiguration configuration =
        maneuver_design::read_automaton_configuration(kFolder + "automata/paper.yaml");
    automaton_ = maneuver_design::build_shared_automaton(configuration);
    specs_ = configuration.subgraphs;
    automaton::SubgraphSpec slow = specs_.at(1);
    slow.name = "slow";
    slow.max_speed_mps = 0.5;
    specs_.push_back(slow);
    automaton::SubgraphSpec stuck = specs_.at(1);
    stuck.name = "stuck";
    stuck.trims = {{0}};
    for (std::size_t from = 1; from < 12; ++from) {
      for (std::size_t to = 0; to < 12; ++to) {
        if (from != to) stuck.disabled_edges.push_back({{{from}, {to}}, std::nullopt});
      }
    }
    specs_.push_back(stuck);
  }
  static void TearDownTestSuite() { automaton_.reset(); }

  Switching() {
    Scenario scenario = read_scenario(
        {.file = kFolder + "scenarios/paper_red_alone.yaml", .profile = "2022", .subgraph = "B"},
        automaton_, specs_);
    scenario.vehicles.front().corridor = {};
    std::vector<std::unique_ptr<controller::Controller>> controllers;
    controllers.push_back(make_controller(scenario, scenario.vehicles.front().id));
    rollout_ = std::make_unique<rollout::Rollout>(
        std::move(controllers), std::vector<Pose>{scenario.vehicles.front().start});
    for (const automaton::SubgraphSpec& spec : specs_) {
      subgraphs_[spec.name] = std::make_shared<const automaton::Subgraph>(automaton_, spec);
    }
  }

  controller::Controller& controller() { return *rollout_->controllers().front(); }
  void switch_to(const std::string& name) {
    const auto& subgraph = subgraphs_.at(name);
    // Half of the times with tables that are there already.
    if (switches_++ % 2 == 0) {
      controller().switch_to(
          controller::prepare_subgraph(subgraph, 8, controller().options().search));
    } else {
      controller().switch_to(subgraph);
    }
  }

  /// One step; the plan in force must go on where the former one was and end standing.
  coordination::Report step() {
    const StepIndex now = rollout_->next_step();
    const bool had_plan = controller().has_plan();
    const Pose expected = had_plan ? controller().plan_in_force().pose_at(now) : Pose{};
    coordination::Report report = rollout_->step().front();
    const coordination::Plan& plan = controller().plan_in_force();
    if (had_plan) {
      EXPECT_EQ(report.planned_pose, expected);
    }
    EXPECT_LE(plan.end().value, now.value + 1 + controller().options().horizon_steps);
    EXPECT_TRUE(automaton_->trims[plan.trim_at(plan.end()).index].is_equilibrium());
    for (StepIndex at = now; at < plan.end(); ++at.value) {
      EXPECT_EQ(plan.maneuver_during(at).to, plan.trim_at({at.value + 1}));
    }
    return report;
  }

  static std::shared_ptr<const automaton::UniversalAutomaton> automaton_;
  static std::vector<automaton::SubgraphSpec> specs_;
  std::unique_ptr<rollout::Rollout> rollout_;
  int switches_{0};
  std::map<std::string, std::shared_ptr<const automaton::Subgraph>> subgraphs_;
};

std::shared_ptr<const automaton::UniversalAutomaton> Switching::automaton_;
std::vector<automaton::SubgraphSpec> Switching::specs_;

TEST_F(Switching, BetweenAllFourSubgraphsEveryStepFindsAPlanAndTheCarDrivesOn) {
  const std::vector<std::string> order{"B", "A", "D", "C", "A", "slow", "D", "B"};
  Point last = controller().has_plan() ? controller().plan_in_force().pose_at({0}).position_m()
                                       : rollout_->step().front().planned_pose.position_m();
  double driven_m = 0.0;
  std::map<std::string, int> driven_with;
  for (std::size_t k = 0; k < 120; ++k) {
    const std::string& name = order[(k / 3) % order.size()];
    if (k % 3 == 0) switch_to(name);
    const coordination::Report report = step();
    SCOPED_TRACE(testing::Message() << "step " << k << " on " << name);
    ASSERT_EQ(report.status, coordination::StepStatus::kPlanned);
    driven_m += (report.planned_pose.position_m() - last).norm();
    last = report.planned_pose.position_m();
    ++driven_with[controller().plan_in_force().maneuver_during(report.step).label];
    // What has been planned in this step is made of this subgraph.
    TrimId trim = controller().plan_in_force().trim_at({report.step.value + 1});
    for (std::size_t j = 1; j <= 8; ++j) {
      const automaton::Maneuver& maneuver =
          controller().plan_in_force().maneuver_during({report.step.value + j});
      bool is_edge = false;
      for (const automaton::Edge& edge : subgraphs_.at(name)->successors(trim)) {
        is_edge = is_edge || edge.maneuver == &maneuver;
      }
      ASSERT_TRUE(is_edge);
      trim = maneuver.to;
    }
  }
  EXPECT_GT(driven_m, 8.0);  // 12.2 m is a lap
  for (const char* label : {"J1", "J2", "J3"}) EXPECT_GT(driven_with[label], 0) << label;
}

TEST_F(Switching, ToASpeedLimitSlowsDownAtOnce) {
  for (int k = 0; k < 12; ++k) static_cast<void>(step());
  ASSERT_GT(automaton_->trims[step().planned_trim.index].speed_mps, 0.6);
  switch_to("slow");
  static_cast<void>(step());  // planned from the next step on
  static_cast<void>(step());  // leaves the disabled trim
  for (int k = 0; k < 20; ++k) {
    const coordination::Report report = step();
    EXPECT_EQ(report.status, coordination::StepStatus::kPlanned);
    EXPECT_LE(automaton::top_speed_mps(controller().plan_in_force().maneuver_during(report.step)),
              0.5);
  }
}

/// Another automaton with the same trims and maneuvers of its own, as for new weights.
class SwitchingAutomata : public Switching {
 protected:
  /// Plans on it for a step.
  void SetUp() override {
    for (int k = 0; k < 10; ++k) static_cast<void>(step());
    auto other = std::make_shared<automaton::UniversalAutomaton>(*automaton_);
    first_ = &other->maneuvers.front();
    last_ = &other->maneuvers.back();
    watched_ = other;
    controller().switch_to(
        std::make_shared<const automaton::Subgraph>(std::move(other), specs_.at(1)));
    EXPECT_EQ(step().status, coordination::StepStatus::kPlanned);
    EXPECT_TRUE(drives_other(rollout_->next_step()));
    EXPECT_TRUE(drives_other(controller().plan_in_force().end()));
  }
  [[nodiscard]] bool drives_other(StepIndex step) {
    const automaton::Maneuver* const maneuver = &controller().plan_in_force().maneuver_during(step);
    return !std::less<>()(maneuver, first_) && !std::less<>()(last_, maneuver);
  }

  const automaton::Maneuver* first_{};
  const automaton::Maneuver* last_{};
  std::weak_ptr<const automaton::UniversalAutomaton> watched_;
};

TEST_F(SwitchingAutomata, TheOneBeforeStaysAsLongAsAPlanThatMayBeDrivenHasManeuversOfIt) {
  switch_to("B");
  for (int k = 0; k < 2; ++k) {
    const coordination::Report report = step();
    EXPECT_EQ(report.status, coordination::StepStatus::kPlanned);
    EXPECT_EQ(drives_other(report.step), k == 0);
    EXPECT_FALSE(drives_other({report.step.value + 1}));
    EXPECT_FALSE(watched_.expired()) << "it is driven, or was a step ago";
  }
  // Its commands may have been received last (replaced_plans.hpp).
  for (std::uint64_t k = 1; k < kDrivableSteps; ++k) {
    static_cast<void>(step());
    EXPECT_FALSE(watched_.expired());
  }
  for (int k = 0; k < 3; ++k) static_cast<void>(step());
  EXPECT_TRUE(watched_.expired());
}

TEST_F(SwitchingAutomata, APlanThatIsDrivenToItsEndStandsOnItsOwn) {
  switch_to("stuck");
  controller().set_minimal_risk_stop(true);
  for (int k = 0; k < 12; ++k) static_cast<void>(step());
  EXPECT_GT(rollout_->next_step(), controller().plan_in_force().end());
  EXPECT_TRUE(drives_other(rollout_->next_step()));
  controller().set_minimal_risk_stop(false);
  switch_to("B");
  for (int k = 0; k < 3; ++k) {
    EXPECT_FALSE(watched_.expired());
    EXPECT_EQ(step().status, coordination::StepStatus::kPlanned);
  }
  for (std::uint64_t k = 0; k < kDrivableSteps; ++k) static_cast<void>(step());
  EXPECT_TRUE(watched_.expired());
}

TEST_F(Switching, WhereNothingCanBePlannedTheFallbackIsDrivenToStandstill) {
  for (int k = 0; k < 13; ++k) static_cast<void>(step());
  switch_to("stuck");
  const StepIndex end = controller().plan_in_force().end();
  coordination::Report report = step();
  EXPECT_EQ(report.status, coordination::StepStatus::kFallback);
  EXPECT_EQ(report.reason, coordination::FallbackReason::kInfeasible);
  for (int k = 0; k < 9; ++k) report = step();
  EXPECT_EQ(automaton_->trims[report.planned_trim.index].speed_mps, 0.0);
  EXPECT_LE(end.value, report.step.value);
  EXPECT_EQ(report.status, coordination::StepStatus::kPlanned);  // standing can be planned again
}

}  // namespace
}  // namespace hlc::scenario::switching_test
