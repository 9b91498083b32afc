// Content of a report: the plan in force and its subgraph.
#include "planner/coordination/report.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <set>
#include <string>

#include "planner/controller/controller.hpp"
#include "tests/planner/automaton/paper_automaton.hpp"
#include "tests/support/test_automaton.hpp"

namespace hlc::controller::report_test {
namespace {

constexpr std::uint64_t kStart = 100;

/// A car alone that stands at the origin and shall drive east; it follows its plan.
class ReportTest : public testing::Test {
 protected:
  void start(std::shared_ptr<const automaton::Subgraph> subgraph, road::Corridor corridor = {}) {
    automaton_ = subgraph->shared_automaton();
    controller_ = std::make_unique<Controller>(
        ControllerOptions{.vehicle = {1}}, std::move(subgraph),
        road::ReferencePath({Point(0.0, 0.0), Point(10.0, 0.0)}, false), std::move(corridor));
  }

  Observation next() {
    vehicle::State state;
    if (controller_->has_plan()) {
      state = controller_->plan_in_force().state_at({k_}, 0.0, automaton_->vehicle);
    }
    coordination::MeasuredVehicle car{
        .vehicle = {1}, .pose = state.pose, .speed_mps = state.speed_mps};
    car.pose.heading_rad += automaton::yaw_minus_heading_rad(
        state.steering_rad, automaton_->vehicle, automaton_->identified);
    return {.step = {k_++}, .active = {{1}}, .states = {car}, .present = {}};
  }

  coordination::Report stand_by() { return controller_->stand_by(next()); }

  coordination::Report step() {
    static_cast<void>(controller_->observe(next()));
    controller_->couple({});
    static_cast<void>(controller_->plan({}));
    return controller_->commit({}, {});
  }

  coordination::Report step_too_late() {
    static_cast<void>(controller_->observe(next()));
    return controller_->fall_back(coordination::FallbackReason::kLate);
  }

  std::shared_ptr<const automaton::UniversalAutomaton> automaton_;
  std::unique_ptr<Controller> controller_;
  std::uint64_t k_{kStart};
};

std::shared_ptr<const automaton::UniversalAutomaton> two_labels() {
  static const std::shared_ptr<const automaton::UniversalAutomaton> automaton =
      test::make_test_automaton(test::paper_trims(), {test::kSlow, test::kFast});
  return automaton;
}

/// Standing, slightly to the right, straight on and slightly to the left.
std::shared_ptr<const automaton::Subgraph> with_label(const std::string& label) {
  const automaton::SubgraphSpec spec{
      .name = "all " + label,
      .labels = {label},
      .trims = {automaton::pi(1), automaton::pi(6), automaton::pi(7), automaton::pi(8)}};
  return std::make_shared<const automaton::Subgraph>(two_labels(), spec);
}

TEST_F(ReportTest, NamesNoManeuverWithoutAPlanAndTheOwnStepOfStandingWhileItStandsBy) {
  start(with_label("slow"));
  const coordination::Report without = controller_->stand_by({.step = {k_++}, .active = {{1}}});
  EXPECT_EQ(without.maneuver, "");
  EXPECT_EQ(without.subgraph, "all slow");
  const coordination::Report standing = stand_by();
  EXPECT_EQ(standing.maneuver, automaton::kSelfLoopLabel);
  EXPECT_EQ(standing.subgraph, "all slow");
  controller_->switch_to(with_label("fast"));
  EXPECT_EQ(stand_by().subgraph, "all fast");
}

// The car stands in the first step; what it plans then is driven in the second, in which it plans
// on another subgraph already.
TEST_F(ReportTest, NamesTheManeuverUnderWayNotOneThatWasPlannedInTheStep) {
  start(with_label("slow"));
  static_cast<void>(stand_by());
  const coordination::Report first = step();
  EXPECT_EQ(first.maneuver, automaton::kSelfLoopLabel);
  EXPECT_EQ(first.subgraph, "all slow");
  controller_->switch_to(with_label("fast"));
  const coordination::Report second = step();
  ASSERT_EQ(second.status, coordination::StepStatus::kPlanned);
  EXPECT_EQ(second.maneuver, "slow");
  EXPECT_EQ(second.subgraph, "all fast");
}

TEST_F(ReportTest, LeadsFromEveryPlannedPoseToTheNextByTheManeuverThatItNames) {
  start(with_label("slow"));
  coordination::Report report = stand_by();
  std::set<std::string> driven;
  for (int k = 0; k < 40; ++k) {
    SCOPED_TRACE(k);
    if (k % 7 == 0) controller_->switch_to(with_label(k % 2 == 0 ? "fast" : "slow"));
    // Driven to its end and from there on again.
    controller_->set_minimal_risk_stop(k % 12 >= 6);
    const coordination::Report next = k % 5 == 4 ? step_too_late() : step();
    const automaton::Maneuver* const maneuver =
        automaton_->find(report.planned_trim, next.planned_trim, report.maneuver);
    ASSERT_NE(maneuver, nullptr) << report.maneuver;
    ASSERT_EQ(maneuver->label, report.maneuver);
    EXPECT_EQ(compose(report.planned_pose, maneuver->displacement), next.planned_pose);
    EXPECT_EQ(next.subgraph, controller_->subgraph().spec().name);
    driven.insert(report.maneuver);
    report = next;
  }
  EXPECT_EQ(driven, (std::set<std::string>{"fast", "slow", automaton::kSelfLoopLabel}));
}

/// A lane along y = 0, `half_width_m` on either side.
road::Corridor lane(double half_width_m) {
  std::vector<road::Corridor::Piece> pieces;
  for (const double y_m : {-half_width_m, half_width_m}) {
    for (double x_m = -1.0; x_m < 9.0; x_m += 0.5) {
      pieces.push_back({{Point(x_m, y_m), Point(x_m + 0.5, y_m)}, x_m, x_m + 0.5});
    }
  }
  return {std::move(pieces), 0.0};
}

// The only way off the disabled trim is a bend that leaves the lane.
TEST_F(ReportTest, NamesTheFormerSubgraphAsLongAsPlansAreFoundOnThat) {
  automaton::SubgraphSpec straight = automaton::paper_configuration().subgraphs.front();
  straight.name = "straight";
  straight.trims = {automaton::pi(1), automaton::pi(7)};
  automaton::SubgraphSpec bend = automaton::paper_configuration().subgraphs.front();
  bend.name = "bend";
  bend.trims = {automaton::pi(1), automaton::pi(8)};
  bend.disabled_edges = {{{automaton::pi(7), automaton::pi(1)}, std::nullopt}};
  const double half_width_m = 0.5 * automaton::paper_automaton()->vehicle.footprint.width_m + 0.005;
  start(std::make_shared<const automaton::Subgraph>(automaton::paper_automaton(), straight),
        lane(half_width_m));
  static_cast<void>(stand_by());
  for (int k = 0; k < 5; ++k) ASSERT_EQ(step().status, coordination::StepStatus::kPlanned) << k;
  controller_->switch_to(
      std::make_shared<const automaton::Subgraph>(automaton::paper_automaton(), bend));
  coordination::Report report = step();
  ASSERT_EQ(report.planned_trim, automaton::pi(7));
  EXPECT_EQ(report.status, coordination::StepStatus::kPlanned);
  EXPECT_EQ(report.subgraph, "straight");
  EXPECT_EQ(controller_->subgraph().spec().name, "bend");
  for (int k = 0; k < 20; ++k) report = step();  // the former one is planned on for a horizon
  EXPECT_EQ(report.subgraph, "bend");
  EXPECT_EQ(report.planned_trim, automaton::pi(1));
}

}  // namespace
}  // namespace hlc::controller::report_test
