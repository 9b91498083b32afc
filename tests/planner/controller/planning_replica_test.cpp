// When a controller can be put in the place of another vehicle's.
#include <gtest/gtest.h>

#include <functional>
#include <vector>

#include "planner/coordination/digest.hpp"
#include "tests/planner/controller/east_bound.hpp"

namespace hlc::controller {
namespace {

using namespace east_bound;

std::unique_ptr<Controller> sharing(std::uint8_t vehicle, double y_m,
                                    const std::function<void(ControllerOptions&)>& change = {}) {
  ControllerOptions options{.vehicle = {vehicle}};
  options.others = [](VehicleId) { return std::unique_ptr<Controller>(); };
  if (change) change(options);
  return std::make_unique<Controller>(
      options, subgraph(), road::ReferencePath({Point(0.0, y_m), Point(10.0, y_m)}, false),
      road::Corridor{});
}

/// Cars 1 and 2 side by side, car 2 in the view of car 1 by its traffic.
class Replica : public testing::Test {
 protected:
  Replica() {
    const std::vector<coordination::MeasuredVehicle> states{seen(1, 0.0, 0.0), seen(2, 0.0, 0.3)};
    for (Controller* one : {one_.get(), two_.get()}) {
      static_cast<void>(one->stand_by(at(100, states)));
    }
    const Observation now = at(101, states);
    from_one_ = one_->observe(now);
    from_two_ = two_->observe(now);
    one_->couple(std::vector{from_two_});
    two_->couple(std::vector{from_one_});
  }

  std::unique_ptr<Controller> one_{sharing(1, 0.0)};
  std::unique_ptr<Controller> two_{sharing(2, 0.3)};
  coordination::Traffic from_one_;
  coordination::Traffic from_two_;
};

TEST_F(Replica, PredictsWhatTheVehiclesOwnControllerPredicts) {
  const std::vector<coordination::Prediction> first{one_->plan({})};
  const coordination::Prediction real = two_->plan(first);
  ASSERT_TRUE(real.is_new);
  const auto replica = sharing(2, 0.3);
  ASSERT_TRUE(replica->resume(from_two_, *one_));
  EXPECT_EQ(digest_of(replica->plan(first)), digest_of(real));
  ASSERT_TRUE(replica->resume(from_two_, *one_));
  EXPECT_NE(digest_of(replica->plan({})), digest_of(real)) << "it depends on the predecessor's";
}

TEST_F(Replica, OfAVehicleThatKeepsItsPlanPredictsThat) {
  from_two_.planning->may_plan = false;
  const auto replica = sharing(2, 0.3);
  ASSERT_TRUE(replica->resume(from_two_, *one_));
  EXPECT_FALSE(replica->plan(std::vector{one_->plan({})}).is_new);
}

TEST_F(Replica, OnAnotherBasisCannotPlan) {
  const std::vector<std::unique_ptr<Controller>> others = [] {
    std::vector<std::unique_ptr<Controller>> result;
    result.push_back(sharing(2, 0.31));
    result.push_back(sharing(3, 0.3));
    for (const std::function<void(ControllerOptions&)>& change :
         std::vector<std::function<void(ControllerOptions&)>>{
             [](ControllerOptions& options) { options.horizon_steps = 7; },
             [](ControllerOptions& options) { options.reference_speed_mps = 0.7; },
             [](ControllerOptions& options) { options.contouring_weight = 1.0; },
             [](ControllerOptions& options) { options.held_up_contouring_weight = 1.0; },
             [](ControllerOptions& options) { options.search.max_expansions = 1000; },
             [](ControllerOptions& options) { options.search.engine = search::Engine::kBestFirst; },
             [](ControllerOptions& options) {
               options.strategies.coordination = kStrictCoordination;
             },
             [](ControllerOptions& options) {
               options.strategies.coupling = &coordination::kAllVehicles;
             },
             [](ControllerOptions& options) {
               options.strategies.grant_order = &right_of_way::kNearestEnd;
             },
             [](ControllerOptions& options) { options.reference_rule = road::mean_speed_first; },
             [](ControllerOptions& options) { options.deviation.reanchor_share = 0.6; },
             [](ControllerOptions& options) { options.lab = vehicle::LabLimits{}; }}) {
      result.push_back(sharing(2, 0.3, change));
    }
    return result;
  }();
  for (std::size_t i = 0; i < others.size(); ++i) {
    EXPECT_FALSE(others[i]->resume(from_two_, *one_)) << i;
  }
}

TEST_F(Replica, OfAVehicleWithOtherObstaclesCannotPlan) {
  one_->add_obstacle({{{3.0, 3.0}, {4.0, 3.0}, {4.0, 4.0}}});
  EXPECT_FALSE(sharing(2, 0.3)->resume(from_two_, *one_)) << "car 2 knows nothing of it";
  two_->add_obstacle({{{3.0, 3.0}, {4.0, 3.0}, {4.0, 4.1}}});
  EXPECT_NE(from_two_.planning->basis, two_->planning_basis());
  EXPECT_NE(one_->planning_basis(), two_->planning_basis());
  from_two_.planning->basis = two_->planning_basis();
  EXPECT_FALSE(sharing(2, 0.3)->resume(from_two_, *one_)) << "a corner is elsewhere";
}

TEST_F(Replica, OfAVehicleWithTheSameObstaclesHasThem) {
  const ConvexPolygon area_m{{{3.0, 3.0}, {4.0, 3.0}, {4.0, 4.0}}};
  one_->add_obstacle(area_m);
  two_->add_obstacle(area_m);
  from_two_.planning->basis = two_->planning_basis();
  const auto replica = sharing(2, 0.3);
  EXPECT_TRUE(replica->resume(from_two_, *one_));
  EXPECT_TRUE(replica->has_obstacles());
}

TEST_F(Replica, OnAnotherSubgraphCannotPlan) {
  const auto replica = sharing(2, 0.3);
  automaton::SubgraphSpec slow = subgraph()->spec();
  slow.max_speed_mps = 0.6;
  replica->switch_to(
      std::make_shared<const automaton::Subgraph>(automaton::paper_automaton(), slow));
  EXPECT_FALSE(replica->resume(from_two_, *one_));
}

TEST_F(Replica, WithOtherSpeedSectionsCannotPlan) {
  const auto with_section = [](double speed_mps) {
    return std::make_unique<Controller>(
        ControllerOptions{.vehicle = {2}}, subgraph(),
        std::vector<road::DrivableRoute>{
            {.name = {},
             .path = road::ReferencePath({Point(0.0, 0.3), Point(10.0, 0.3)}, false),
             .corridor = {},
             .speed_sections = {{1.0, 2.0, speed_mps}}}});
  };
  const auto slow = with_section(0.4);
  EXPECT_FALSE(slow->resume(from_two_, *one_));
  EXPECT_NE(slow->planning_basis(), with_section(0.5)->planning_basis());
  from_two_.planning->basis = slow->planning_basis();
  EXPECT_TRUE(slow->resume(from_two_, *one_));
}

TEST_F(Replica, RejectsNonsense) {
  const auto replica = sharing(2, 0.3);
  ASSERT_TRUE(replica->resume(from_two_, *one_));
  const auto rejects = [&](const std::function<void(coordination::Traffic&)>& change) {
    coordination::Traffic changed = from_two_;
    change(changed);
    return !replica->resume(changed, *one_);
  };
  EXPECT_TRUE(rejects([](coordination::Traffic& one) { one.planning.reset(); }));
  EXPECT_TRUE(rejects([](coordination::Traffic& one) { one.planning->route = 1; }));
  EXPECT_TRUE(rejects([](coordination::Traffic& one) { one.planning->seen_time_s = -1.0; }));
  EXPECT_TRUE(
      rejects([](coordination::Traffic& one) { one.planning->base.standstill = 1'000'000; }));
  EXPECT_TRUE(rejects([](coordination::Traffic& one) { one.next_pose.x_m += 1e-12; }));
  EXPECT_TRUE(rejects([](coordination::Traffic& one) { one.next_trim = {6}; }));
  EXPECT_TRUE(rejects([](coordination::Traffic& one) { one.claim.emplace(); }));
}

// A plan on the former subgraph may follow a switch: the others do not know that one.
TEST_F(Replica, HasNoPlanningInputWhileItsVehicleMayPlanOnAFormerSubgraph) {
  EXPECT_TRUE(from_two_.planning);
  static_cast<void>(two_->fall_back(coordination::FallbackReason::kLate));
  automaton::SubgraphSpec slow = subgraph()->spec();
  slow.max_speed_mps = 0.6;
  two_->switch_to(std::make_shared<const automaton::Subgraph>(automaton::paper_automaton(), slow));
  EXPECT_FALSE(two_->observe(at(102, {seen(2, 0.0, 0.3)})).planning);
}

TEST(PlanningInputOfAController, IsPublishedInTwoRoundsOnly) {
  const auto one = controller(1);
  static_cast<void>(one->stand_by(at(100, {seen(1, 0.0, 0.0)})));
  EXPECT_FALSE(one->observe(at(101, {seen(1, 0.0, 0.0)})).planning);
}

}  // namespace
}  // namespace hlc::controller
