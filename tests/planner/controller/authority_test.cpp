#include "planner/controller/authority.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <random>

#include "planner/controller/followed_plan.hpp"
#include "planner/controller/joint_step.hpp"
#include "planner/right_of_way/grant.hpp"
#include "planner/scenario/starts.hpp"
#include "tests/planner/automaton/paper_automaton.hpp"
#include "tests/planner/controller/ring.hpp"
#include "tests/planner/right_of_way/held_cells.hpp"
#include "tests/planner/right_of_way/routes.hpp"
#include "tests/support/num_seeds.hpp"

namespace hlc::controller::authority_test {
namespace {

using coordination::LaneClaim;
using coordination::Traffic;

constexpr double kLookAhead_m = 1.0;
constexpr double kReach_m = 2.0;

class AuthorityTest : public testing::Test {
 protected:
  void begin_step(const coordination::Plan& plan, std::uint64_t step) {
    authority_.begin_step(plan, {step}, ring_.tracker, kReach_m);
  }
  void extend(const std::vector<Traffic>& others, const std::vector<VehicleId>& missing = {},
              double step_m = 0.0) {
    std::vector<const Traffic*> pointers;
    for (const Traffic& other : others) pointers.push_back(&other);
    SharedStep shared;
    authority_.receive(pointers);
    authority_.extend({1}, pointers, missing, {}, step_m, shared);
  }
  [[nodiscard]] double end_m() const {
    return authority_.claim().place_m + authority_.claim().ahead_m;
  }

  Ring ring_;
  Authority authority_{ring_.map};
};

TEST_F(AuthorityTest, AVehicleThatStandsHoldsItsPlaceOnly) {
  begin_step(ring_.standing(1.0), 1);
  EXPECT_NEAR(authority_.claim().place_m, 1.0, 1e-9);
  EXPECT_EQ(authority_.claim().ahead_m, 0.0);
  EXPECT_EQ(authority_.claim().waiting_steps, 0U);
}

// A waiting car whose place was taken for another one of its tour held 120 m of it, and twenty cars
// stood for good.
TEST_F(AuthorityTest, AVehicleThatIsElsewhereOnItsRouteHoldsItsPlaceOnly) {
  ring_.tracker.select_route(ring_.pose_on(6.0), car().footprint);
  begin_step(ring_.standing(6.0), 1);
  extend({});
  ASSERT_NEAR(authority_.claim().ahead_m, kLookAhead_m, ring_.map->cell_m(0));
  ring_.tracker.select_route(ring_.pose_on(3.0), car().footprint);
  begin_step(ring_.standing(3.0), 2);
  EXPECT_NEAR(authority_.claim().place_m, 3.0, 1e-9);
  EXPECT_EQ(authority_.claim().ahead_m, 0.0);
}

TEST_F(AuthorityTest, TheEndIsNeverInFrontOfThePlansEnd) {
  const coordination::Plan plan = ring_.driving(0.3);
  for (std::uint64_t step = 1; step <= 8; ++step) {
    begin_step(plan, step);
    EXPECT_NEAR(end_m(), 0.3 + 0.32, 0.01) << step;
    EXPECT_GE(authority_.claim().ahead_m, 0.0) << step;
  }
}

TEST_F(AuthorityTest, TheEndOfThePlanCountsAlsoBeyondTheEndOfTheRoute) {
  const double length_m = ring_.path().length_m();
  ring_.tracker.select_route(ring_.pose_on(length_m - 0.1), car().footprint);
  const coordination::Plan plan = ring_.driving(length_m - 0.1);
  begin_step(plan, 1);
  EXPECT_NEAR(authority_.claim().ahead_m, 0.32, 0.01);
  begin_step(plan, 5);  // the place has passed the end
  EXPECT_LT(authority_.claim().place_m, 0.2);
  EXPECT_NEAR(end_m(), 0.22, 0.01);
}

TEST_F(AuthorityTest, WhatWasGrantedIsKeptWhileTheVehicleMoves) {
  const coordination::Plan plan = ring_.driving(0.3);
  begin_step(plan, 1);
  extend({});
  const double granted_m = end_m();
  EXPECT_NEAR(granted_m, 0.3 + kLookAhead_m, ring_.map->cell_m(0));
  for (std::uint64_t step = 2; step <= 8; ++step) {
    begin_step(plan, step);
    EXPECT_NEAR(end_m(), granted_m, 1e-9) << step;
    EXPECT_NEAR(authority_.end_s_m(authority_.claim().place_m + 0.1), granted_m, 1e-9) << step;
  }
}

TEST_F(AuthorityTest, StepsOfStandingAreCountedAndStartAgainWhenTheVehicleHasMoved) {
  const coordination::Plan plan = ring_.driving(0.3);
  std::vector<std::uint32_t> waiting_steps;
  for (std::uint64_t step = 1; step <= 9; ++step) {
    begin_step(plan, step);
    waiting_steps.push_back(authority_.claim().waiting_steps);
  }
  EXPECT_EQ(waiting_steps, (std::vector<std::uint32_t>{0, 1, 2, 0, 0, 0, 1, 2, 3}));
}

// A car waited behind another one's road, and gave two cells of its lane back, which it could not
// use, in the very steps in which the other one gave back the road that neither of them used. So
// the same one was granted it again and again, and four of ten cars stood for good.
TEST_F(AuthorityTest, WhoGivesBackOnlyRoadOfItsLaneKeepsItsPlaceInTheQueue) {
  for (std::uint64_t step = 1; step <= std::uint64_t{3} * Authority::kPatience_steps; ++step) {
    begin_step(ring_.standing(1.0), step);
    EXPECT_EQ(authority_.claim().waiting_steps, step - 1);
    EXPECT_EQ(authority_.claim().ahead_m == 0.0, step % Authority::kPatience_steps == 1) << step;
    extend({});
  }
}

TEST_F(AuthorityTest, WhoWasSetDownWithinUnusedRoadOfAnotherOneGetsOn) {
  ring_.tracker.select_route(ring_.pose_on(1.5), car().footprint);
  Traffic behind = Ring::other_at(2, 1.0, 1.0);
  begin_step(ring_.standing(1.5), 1);
  extend({behind});
  EXPECT_NEAR(end_m(), 1.5, 1e-9);
  behind.claim->ahead_m = 0.0;  // given back
  begin_step(ring_.standing(1.5), 2);
  extend({behind});
  EXPECT_NEAR(end_m(), 1.5 + kLookAhead_m, ring_.map->cell_m(0));
}

TEST_F(AuthorityTest, WhoWasMovedHoldsItsNewPlaceOnly) {
  begin_step(ring_.standing(1.0), 1);
  extend({});
  authority_.release();
  begin_step(ring_.standing(0.5), 2);
  EXPECT_NEAR(authority_.claim().place_m, 0.5, 0.01);
  EXPECT_EQ(authority_.claim().ahead_m, 0.0);
}

TEST_F(AuthorityTest, WhoHoldsNothingButItsPlaceKeepsItsPlaceInTheQueue) {
  static_assert(Authority::kPatience_steps < 75);
  for (std::uint64_t step = 1; step <= 75; ++step) {
    begin_step(ring_.standing(1.0), step);
    EXPECT_EQ(authority_.claim().waiting_steps, step - 1);
    extend({Ring::other_at(2, 1.0 + car().footprint.length_m + 0.03)});
  }
}

TEST_F(AuthorityTest, ItEndsBehindTheVehicleAhead) {
  begin_step(ring_.standing(1.0), 1);
  extend({Ring::other_at(2, 2.0, 0.5)});
  EXPECT_LT(end_m(), 2.0 - car().footprint.length_m);
  EXPECT_GT(end_m(), 2.0 - car().footprint.length_m - 0.1);
  begin_step(ring_.standing(1.0), 2);
  extend({Ring::other_at(2, 2.2, 0.5)});
  EXPECT_GT(end_m(), 2.2 - car().footprint.length_m - 0.1) << "that one has driven on";
}

TEST_F(AuthorityTest, TheEndIsNeverBeforeAPlaceOfTheVehicle) {
  begin_step(ring_.standing(1.0), 1);
  extend({Ring::other_at(2, 1.6)});
  EXPECT_DOUBLE_EQ(authority_.end_s_m(1.0), end_m());
  EXPECT_DOUBLE_EQ(authority_.end_s_m(2.0), 2.0);
  const double length_m = ring_.path().length_m();
  EXPECT_NEAR(authority_.end_s_m(1.0 + length_m), end_m() + length_m, 1e-9) << "a lap later";
}

TEST_F(AuthorityTest, TheBarLiesBehindTheEndAcrossTheLane) {
  for (std::uint64_t seed = 0; seed < test::num_seeds(100); ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937_64 random(seed);
    const double place_m = std::uniform_real_distribution(0.0, 1.5)(random);
    const double gap_m = std::uniform_real_distribution(0.4, 1.5)(random);
    authority_ = Authority(ring_.map);
    begin_step(ring_.standing(place_m), 1);
    extend({Ring::other_at(2, place_m + gap_m)});
    const ConvexPolygon bar_m = authority_.bar_m(ring_.tracker, car().footprint);
    const auto at_end = [&](double beyond_m) {
      return footprint_area(car().footprint, ring_.pose_on(end_m() + beyond_m));
    };
    EXPECT_FALSE(intersects(bar_m, at_end(0.0))) << "it may stop at the end";
    EXPECT_GT(distance_m(bar_m, at_end(0.0)), 0.01);
    EXPECT_TRUE(intersects(bar_m, at_end(0.05)));
    const Box box = bounding_box(bar_m);
    EXPECT_GT((box.max_m - box.min_m).norm(), car().footprint.width_m + 0.02);
  }
}

TEST_F(AuthorityTest, OnlyWhoHoldsWhatIsWantedNextWithholdsIt) {
  begin_step(ring_.standing(1.0), 1);
  extend({Ring::other_at(2, 1.0 + kLookAhead_m)});
  EXPECT_EQ(authority_.withheld_by(), std::vector<VehicleId>{{2}});
  begin_step(ring_.standing(1.0), 2);
  extend({Ring::other_at(2, 1.0 + kLookAhead_m + car().footprint.length_m + 0.045)});
  EXPECT_NEAR(end_m(), 1.0 + kLookAhead_m, 0.04);
  EXPECT_TRUE(authority_.withheld_by().empty()) << "the next cell, which it holds, is too far away";
}

/// The controller of vehicle 1 on the ring; vehicle 2 stands on it, far ahead.
class ControllerWithAuthority : public testing::Test {
 protected:
  enum class Other { kReceived, kSilent, kGone, kUnseen };
  static constexpr double kOther_m = 6.0;

  void SetUp() override {
    static_cast<void>(one_.stand_by(
        {.step = {step_},
         .active = {{1}},
         .states = {as_measured({1}, {.pose = ring_.pose_on(0.0)}, *automaton::paper_automaton())},
         .present = {}}));
  }

  /// One step. Returns what is claimed in it: the result of the step before.
  /// @param moved_to_m  where the vehicle stands instead of following its plan
  LaneClaim step(Other other, std::optional<double> moved_to_m = {}) {
    ++step_;
    Observation observation{.step = {step_}, .active = {{1}, {2}}};
    observation.states = {
        moved_to_m
            ? as_measured({1}, {.pose = ring_.pose_on(*moved_to_m)}, *automaton::paper_automaton())
            : on_its_plan(one_, {step_}),
        as_measured({2}, {.pose = ring_.pose_on(kOther_m)}, *automaton::paper_automaton())};
    if (other == Other::kUnseen) observation.states.pop_back();
    observation.present = {{1}};
    if (other != Other::kGone) observation.present.push_back({2});
    const Traffic own = one_.observe(observation);
    Traffic traffic = Ring::other_at(2, kOther_m);
    traffic.step = {step_};
    traffic.next_pose = ring_.pose_on(kOther_m);
    traffic.reachable_area_m = footprint_area(car().footprint, traffic.next_pose, 0.010);
    traffic.running = {.first = {step_}, .areas_m = {}, .final_area_m = traffic.reachable_area_m};
    one_.couple(other == Other::kReceived ? std::vector{traffic} : std::vector<Traffic>{});
    static_cast<void>(one_.plan({}));
    static_cast<void>(one_.commit({}, {}));
    return own.claim.value();
  }
  static double end_m(const LaneClaim& claim) { return claim.place_m + claim.ahead_m; }

  Ring ring_;
  std::uint64_t step_{100};
  Controller one_{
      ControllerOptions{.vehicle = {1}, .conflicts = ring_.map},
      std::make_shared<const automaton::Subgraph>(
          automaton::paper_automaton(), automaton::paper_configuration().subgraphs.front()),
      ring_.tracker.routes()};
};

TEST_F(ControllerWithAuthority, NothingIsTakenWhileAVehicleMayBeAnywhere) {
  for (int i = 0; i < 20; ++i) EXPECT_EQ(step(Other::kUnseen).ahead_m, 0.0) << i;
  static_cast<void>(step(Other::kReceived));
  EXPECT_GT(step(Other::kReceived).ahead_m, kLookAhead_m - 0.05);
}

TEST_F(ControllerWithAuthority, WhatASilentVehicleHoldsIsNotTaken) {
  for (int i = 0; i < 3; ++i) static_cast<void>(step(Other::kReceived));
  double farthest_m = 0.0;
  for (int i = 0; i < 60; ++i) {
    farthest_m = std::max(farthest_m, end_m(step(Other::kSilent)));
  }
  EXPECT_LT(farthest_m, kOther_m - car().footprint.length_m);
}

TEST_F(ControllerWithAuthority, AMissingVehicleThatStandsForGoodIsBlockedArea) {
  static_cast<void>(step(Other::kReceived));
  LaneClaim claim;
  double farthest_m = 0.0;
  for (int i = 0; i < 90; ++i) {
    claim = step(Other::kGone);
    farthest_m = std::max(farthest_m, end_m(claim));
  }
  EXPECT_LT(farthest_m, kOther_m - car().footprint.length_m);
  EXPECT_GT(farthest_m, kOther_m - car().footprint.length_m - 0.15);
  EXPECT_GT(claim.waiting_steps, 5U);
}

// It claimed a wrong place for a step, or the road up to where it had come from.
TEST_F(ControllerWithAuthority, AVehicleThatWasMovedClaimsItsNewPlaceOnlyOnceItIsPlannedThere) {
  for (const double moved_to_m : {3.0, 2.0}) {
    for (int i = 0; i < 5; ++i) static_cast<void>(step(Other::kReceived));
    LaneClaim claim;
    for (int i = 0; i < 20; ++i) {
      claim = step(Other::kReceived, moved_to_m);
      if (std::abs(claim.place_m - moved_to_m) < 0.05) break;
    }
    EXPECT_NEAR(claim.place_m, moved_to_m, 0.05);
    EXPECT_EQ(claim.ahead_m, 0.0);
    EXPECT_EQ(one_.plan_in_force().first(), StepIndex{step_});
  }
}

/// Steps cars of the lab, and grants beside them.
class GrantedRun {
 public:
  explicit GrantedRun(const scenario::Scenario& scenario) : map_(*scenario.conflicts) {
    for (const scenario::ScenarioVehicle& vehicle : scenario.vehicles) {
      controllers_.push_back(scenario::make_controller(scenario, vehicle.id));
      static_cast<void>(controllers_.back()->stand_by(
          {.step = {0},
           .active = {vehicle.id},
           .states = {as_measured(vehicle.id, {.pose = vehicle.start},
                                  controllers_.back()->subgraph().automaton())},
           .present = {}}));
    }
  }

  /// Returns what all hold as the step begins.
  /// @param is_lost  of the messages; may be absent
  std::vector<right_of_way::Holder> drive(
      std::uint64_t step, const std::function<bool(const Delivery&)>& is_lost = {}) {
    Observation observation{.step = {step}};
    std::vector<Controller*> controllers;
    for (const auto& one : controllers_) {
      controllers.push_back(one.get());
      observation.active.push_back(one->options().vehicle);
      observation.states.push_back(on_its_plan(*one, {step}));
    }
    observation.present = observation.active;
    std::vector<right_of_way::Holder> holders;
    const std::vector<coordination::Report> reports = joint_step(
        controllers, observation,
        {.is_lost = is_lost, .on_traffic = [&](const Controller&, const Traffic& traffic) {
           holders.push_back({traffic.vehicle, traffic.claim.value()});
         }});
    for (const right_of_way::Holder& holder : holders) check_end(holder);
    for (const coordination::Report& report : reports) held_[report.vehicle] = report.held.value();
    return holders;
  }

  void step(std::uint64_t step) {
    const std::vector<right_of_way::Holder> holders = drive(step);
    const std::vector<double> ahead_m = right_of_way::grant(map_, holders, {}, kLookAhead_m);
    for (std::size_t i = 0; i < holders.size(); ++i) check(i, holders[i].claim, ahead_m[i]);
  }

  [[nodiscard]] double driven_m() const { return driven_m_; }
  [[nodiscard]] std::size_t limited_plans() const { return limited_plans_; }

 private:
  /// What a vehicle holds as a step begins reaches to the end of its plan at least: cells that it
  /// held in the last step, since none is granted in between.
  void check_end(const right_of_way::Holder& holder) const {
    const auto last = held_.find(holder.vehicle);
    if (last == held_.end()) return;
    const LaneClaim& claim = holder.claim;
    const auto end = [&](double place_m, double ahead_m) {
      return map_.count_at(claim.route, place_m + ahead_m);
    };
    const auto laps = static_cast<std::int64_t>(map_.num_cells(claim.route));
    const std::int64_t taken =
        (end(claim.place_m, claim.ahead_m) - end(last->second.place_m, last->second.ahead_m)) %
        laps;
    EXPECT_TRUE(taken <= 0 || taken > laps / 2)
        << "the plan of vehicle " << int{holder.vehicle.value} << " ends " << taken << " cells on";
  }

  void check(std::size_t i, const LaneClaim& claim, double ahead_m) {
    const coordination::Plan& plan = controllers_[i]->plan_in_force();
    const road::ReferencePath& path = controllers_[i]->route().path;
    const Point end_m = plan.pose_at(plan.end()).position_m();
    const double plans_m =
        path.project_within(end_m, claim.place_m - 0.2, claim.place_m + 3.0).s_m - claim.place_m;
    const double ends_m = std::remainder(plans_m, path.length_m());
    // The bar lies 20 mm behind a car that stands at the end.
    EXPECT_LT(ends_m, ahead_m + 0.03) << "vehicle " << i + 1;
    limited_plans_ += ends_m > ahead_m - 0.1 ? 1U : 0U;
    if (const auto last = last_m_.find(i); last != last_m_.end()) {
      driven_m_ += std::max(0.0, std::remainder(claim.place_m - last->second, path.length_m()));
    }
    last_m_[i] = claim.place_m;
  }

  const right_of_way::ConflictMap& map_;
  std::vector<std::unique_ptr<Controller>> controllers_;
  std::map<std::size_t, double> last_m_;
  std::map<VehicleId, coordination::HeldRoad> held_;  ///< in the last step
  double driven_m_{};
  std::size_t limited_plans_{};
};

TEST(AuthorityInTheLab, NoPlanInForceEndsBeyondTheAuthority) {
  const scenario::Scenario few = scenario::read_scenario(
      {.file = test::source_folder() + "/launch_scripts/scenarios/lab_cars.yaml", .cars = 8});
  std::size_t limited_plans = 0;
  for (std::uint64_t seed = 1; seed <= test::num_costly_seeds(2); ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    const scenario::Scenario drawn = scenario::with_random_starts(few, seed);
    GrantedRun run(drawn);
    for (std::uint64_t step = 1; step <= 60; ++step) run.step(step);
    EXPECT_GT(run.driven_m(), 8 * 3.0);
    limited_plans += run.limited_plans();
  }
  EXPECT_GT(limited_plans, 20U) << "no authority ever limited a plan";
}

// A vehicle planned around the end of its authority, over the lane beside it, to get away from all
// places where a missing one could be.
TEST(AuthorityInTheLab, NoTwoVehiclesHoldTheSameRoadWhateverIsLost) {
  const scenario::Scenario few = scenario::read_scenario(
      {.file = test::source_folder() + "/launch_scripts/scenarios/lab_cars.yaml", .cars = 10});
  for (std::uint64_t seed = 1; seed <= test::num_costly_seeds(3); ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    const scenario::Scenario drawn = scenario::with_random_starts(few, seed);
    std::mt19937_64 random(seed);
    const auto is_lost = [&](const Delivery&) { return std::bernoulli_distribution(0.1)(random); };
    GrantedRun run(drawn);
    std::map<VehicleId, double> held_m;
    for (std::uint64_t step = 1; step <= 40; ++step) {
      const std::vector<right_of_way::Holder> holders = run.drive(step, is_lost);
      for (std::size_t i = 0; i < holders.size(); ++i) {
        held_m[holders[i].vehicle] += holders[i].claim.ahead_m;
        for (std::size_t j = 0; j < i; ++j) {
          ASSERT_FALSE(hold_overlapping_cells(*drawn.conflicts, holders[i], holders[j]))
              << "step " << step << ": " << i << ' ' << j;
        }
      }
    }
    for (const auto& [vehicle, sum_m] : held_m)
      EXPECT_GT(sum_m, 40 * 0.2) << vehicle.value << ", measured: 40 * 0.26 and more";
  }
}

}  // namespace
}  // namespace hlc::controller::authority_test
