// Content of a report: the plan in force and its subgraph.
#include "planner/coordination/report.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <set>
#include <string>

#include "planner/controller/controller.hpp"
#include "tests/planner/automaton/paper_automaton.hpp"
#include "tests/support/test_automaton.hpp"

namespace hlc::report_test {
namespace {

constexpr std::uint64_t kStart = 100;

/// A car alone that stands at the origin and shall drive east; it follows its plan.
class ReportTest : public testing::Test {
 protected:
  void start(std::shared_ptr<const Subgraph> subgraph, Corridor corridor = {}) {
    automaton_ = subgraph->shared_automaton();
    controller_ = std::make_unique<Controller>(
        ControllerOptions{.vehicle = {1}}, std::move(subgraph),
        ReferencePath({Point(0.0, 0.0), Point(10.0, 0.0)}, false), std::move(corridor));
  }

  Observation next() {
    State state;
    if (controller_->has_plan()) {
      state = controller_->plan_in_force().state_at({k_}, 0.0, automaton_->vehicle);
    }
    MeasuredVehicle car{.vehicle = {1}, .pose = state.pose, .speed_mps = state.speed_mps};
    car.pose.heading_rad +=
        yaw_minus_heading_rad(state.steering_rad, automaton_->vehicle, automaton_->identified);
    return {.step = {k_++}, .active = {{1}}, .states = {car}, .present = {}};
  }

  Report stand_by() { return controller_->stand_by(next()); }

  Report step() {
    static_cast<void>(controller_->observe(next()));
    controller_->couple({});
    static_cast<void>(controller_->plan({}));
    return controller_->commit({}, {});
  }

  Report step_too_late() {
    static_cast<void>(controller_->observe(next()));
    return controller_->fall_back(FallbackReason::kLate);
  }

  std::shared_ptr<const UniversalAutomaton> automaton_;
  std::unique_ptr<Controller> controller_;
  std::uint64_t k_{kStart};
};

std::shared_ptr<const UniversalAutomaton> two_labels() {
  static const std::shared_ptr<const UniversalAutomaton> automaton =
      test::make_test_automaton(test::paper_trims(), {test::kSlow, test::kFast});
  return automaton;
}

/// Standing, slightly to the right, straight on and slightly to the left.
std::shared_ptr<const Subgraph> with_label(const std::string& label) {
  const SubgraphSpec spec{
      .name = "all " + label, .labels = {label}, .trims = {pi(1), pi(6), pi(7), pi(8)}};
  return std::make_shared<const Subgraph>(two_labels(), spec);
}

TEST_F(ReportTest, NamesNoManeuverWithoutAPlanAndTheOwnStepOfStandingWhileItStandsBy) {
  start(with_label("slow"));
  const Report without = controller_->stand_by({.step = {k_++}, .active = {{1}}});
  EXPECT_EQ(without.maneuver, "");
  EXPECT_EQ(without.subgraph, "all slow");
  const Report standing = stand_by();
  EXPECT_EQ(standing.maneuver, kSelfLoopLabel);
  EXPECT_EQ(standing.subgraph, "all slow");
  controller_->switch_to(with_label("fast"));
  EXPECT_EQ(stand_by().subgraph, "all fast");
}

// The car stands in the first step; what it plans then is driven in the second, in which it plans
// on another subgraph already.
TEST_F(ReportTest, NamesTheManeuverUnderWayNotOneThatWasPlannedInTheStep) {
  start(with_label("slow"));
  static_cast<void>(stand_by());
  const Report first = step();
  EXPECT_EQ(first.maneuver, kSelfLoopLabel);
  EXPECT_EQ(first.subgraph, "all slow");
  controller_->switch_to(with_label("fast"));
  const Report second = step();
  ASSERT_EQ(second.status, StepStatus::kPlanned);
  EXPECT_EQ(second.maneuver, "slow");
  EXPECT_EQ(second.subgraph, "all fast");
}

TEST_F(ReportTest, LeadsFromEveryPlannedPoseToTheNextByTheManeuverThatItNames) {
  start(with_label("slow"));
  Report report = stand_by();
  std::set<std::string> driven;
  for (int k = 0; k < 40; ++k) {
    SCOPED_TRACE(k);
    if (k % 7 == 0) controller_->switch_to(with_label(k % 2 == 0 ? "fast" : "slow"));
    // Driven to its end and from there on again.
    controller_->set_minimal_risk_stop(k % 12 >= 6);
    const Report next = k % 5 == 4 ? step_too_late() : step();
    const Maneuver* const maneuver =
        automaton_->find(report.planned_trim, next.planned_trim, report.maneuver);
    ASSERT_NE(maneuver, nullptr) << report.maneuver;
    ASSERT_EQ(maneuver->label, report.maneuver);
    EXPECT_EQ(compose(report.planned_pose, maneuver->displacement), next.planned_pose);
    EXPECT_EQ(next.subgraph, controller_->subgraph().spec().name);
    driven.insert(report.maneuver);
    report = next;
  }
  EXPECT_EQ(driven, (std::set<std::string>{"fast", "slow", kSelfLoopLabel}));
}

/// A lane along y = 0, `half_width_m` on either side.
Corridor lane(double half_width_m) {
  std::vector<Corridor::Piece> pieces;
  for (const double y_m : {-half_width_m, half_width_m}) {
    for (double x_m = -1.0; x_m < 9.0; x_m += 0.5) {
      pieces.push_back({{Point(x_m, y_m), Point(x_m + 0.5, y_m)}, x_m, x_m + 0.5});
    }
  }
  return {std::move(pieces), 0.0};
}

// The only way off the trim that is off now is a bend that leaves the lane.
TEST_F(ReportTest, NamesTheFormerSubgraphAsLongAsPlansAreFoundOnThat) {
  SubgraphSpec straight = paper_configuration().subgraphs.front();
  straight.name = "straight";
  straight.trims = {pi(1), pi(7)};
  SubgraphSpec bend = paper_configuration().subgraphs.front();
  bend.name = "bend";
  bend.trims = {pi(1), pi(8)};
  bend.off = {{{pi(7), pi(1)}, std::nullopt}};
  const double half_width_m = 0.5 * paper_automaton()->vehicle.footprint.width_m + 0.005;
  start(std::make_shared<const Subgraph>(paper_automaton(), straight), lane(half_width_m));
  static_cast<void>(stand_by());
  for (int k = 0; k < 5; ++k) ASSERT_EQ(step().status, StepStatus::kPlanned) << k;
  controller_->switch_to(std::make_shared<const Subgraph>(paper_automaton(), bend));
  Report report = step();
  ASSERT_EQ(report.planned_trim, pi(7));
  EXPECT_EQ(report.status, StepStatus::kPlanned);
  EXPECT_EQ(report.subgraph, "straight");
  EXPECT_EQ(controller_->subgraph().spec().name, "bend");
  for (int k = 0; k < 20; ++k) report = step();  // the former one is planned on for a horizon
  EXPECT_EQ(report.subgraph, "bend");
  EXPECT_EQ(report.planned_trim, pi(1));
}

}  // namespace
}  // namespace hlc::report_test
