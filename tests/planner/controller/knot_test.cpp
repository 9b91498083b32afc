// Cars that stand where lanes merge, on road of their own, beside one that waits for them.
#include <gtest/gtest.h>

#include <random>

#include "planner/controller/controller.hpp"
#include "planner/controller/followed_plan.hpp"
#include "planner/controller/joint_step.hpp"
#include "planner/controller/lane_entry.hpp"
#include "planner/controller/plan_end.hpp"
#include "planner/controller/self_loop.hpp"
#include "planner/coordination/commit.hpp"
#include "planner/scenario/scenario.hpp"
#include "planner/scenario/starts.hpp"
#include "tests/support/folders.hpp"
#include "tests/support/num_seeds.hpp"

namespace hlc::controller::knot_test {
namespace {

constexpr VehicleId kOwn{16};
constexpr VehicleId kWaiting{8};
/// Of a run of 300 s in which twenty cars came to a standstill behind these two: the left front
/// corner 1 mm from the lane's bound, 3 mm between the margins.
constexpr Pose kOwnPose{2.7103, 3.6795, 0.5241};
constexpr Pose kWaitingPose{2.6716, 3.4641, 0.8593};

const scenario::Scenario& lab_cars() {
  static const scenario::Scenario kScenario = scenario::read_scenario(
      {.file = test::source_folder() + "/launch_scripts/scenarios/lab_cars.yaml",
       .cars = 20,
       .seed = 21});
  return kScenario;
}

const vehicle::VehicleParameters& car() { return lab_cars().subgraph->automaton().vehicle; }

Pose moved_at_random(const Pose& pose, double most_m, double most_rad, std::mt19937_64& random) {
  std::uniform_real_distribution<double> moved_m(-most_m, most_m);
  std::uniform_real_distribution<double> turned_rad(-most_rad, most_rad);
  return {pose.x_m + moved_m(random), pose.y_m + moved_m(random),
          pose.heading_rad + turned_rad(random)};
}

/// Steps the controller of the one; the other stands and claims its place.
class BesideAWaitingCar {
 public:
  BesideAWaitingCar(const Pose& own, const Pose& waiting)
      : waiting_(waiting),
        area_m_(standing_area_m(waiting)),
        controller_(scenario::make_controller(lab_cars(), kOwn)) {
    static_cast<void>(controller_->stand_by(
        {.step = {step_}, .active = {kOwn}, .states = {measured(kOwn, own)}, .present = {}}));
  }

  void step() {
    ++step_;
    static_cast<void>(controller_->observe(
        {.step = {step_},
         .active = {kOwn, kWaiting},
         .states = {on_its_plan(*controller_, {step_}), measured(kWaiting, waiting_)},
         .present = {kOwn, kWaiting}}));
    controller_->couple(std::vector{traffic()});
    const coordination::Prediction standing{
        .vehicle = kWaiting, .step = {step_}, .is_new = false, .areas = areas_from(step_ + 1)};
    static_cast<void>(controller_->plan(std::vector{standing}));
    static_cast<void>(controller_->commit(std::vector{standing}, {}));
  }

  [[nodiscard]] const Controller& controller() const { return *controller_; }
  [[nodiscard]] const coordination::Plan& plan() const { return controller_->plan_in_force(); }
  [[nodiscard]] Pose pose() const { return plan().pose_at({step_}); }
  [[nodiscard]] double driven_m(const Pose& from) const {
    return (pose().position_m() - from.position_m()).norm();
  }
  [[nodiscard]] bool is_plan_free() const {
    const StepIndex next{step_ + 1};
    return coordination::are_free(plan().areas_from(next), area_m_, next,
                                  controller_->options().horizon_steps);
  }
  [[nodiscard]] bool keeps_to_its_lanes() const {
    const road::Corridor& lanes = controller_->route().corridor;
    return keeps_to(plan(), {step_ + 1}, lanes.boundary_m(0.0, lanes.route_length_m()));
  }

 private:
  [[nodiscard]] static ConvexPolygon standing_area_m(const Pose& pose) {
    const automaton::Subgraph& on = *lab_cars().subgraph;
    return transformed(self_loop(on.automaton(), on.standstill()).swept_area_m, pose);
  }
  [[nodiscard]] static coordination::MeasuredVehicle measured(VehicleId vehicle, const Pose& pose) {
    return as_measured(vehicle, {.pose = pose}, lab_cars().subgraph->automaton());
  }
  [[nodiscard]] coordination::OccupiedAreas areas_from(std::uint64_t step) const {
    return {.first = {step}, .areas_m = {}, .final_area_m = area_m_};
  }
  [[nodiscard]] coordination::Traffic traffic() const {
    const scenario::ScenarioVehicle& other = scenario::vehicle_of(lab_cars(), kWaiting);
    const road::Placement place = road::placement_on(
        {.name = {}, .path = other.path, .corridor = other.corridor}, waiting_, car().footprint);
    return {.vehicle = kWaiting,
            .step = {step_},
            .next_pose = waiting_,
            .next_trim = lab_cars().subgraph->standstill(),
            .running = areas_from(step_),
            .reachable_area_m = area_m_,
            .silent = {},
            .claim = coordination::LaneClaim{.route = other.route_number,
                                             .place_m = place.s_m,
                                             .ahead_m = 0.014,
                                             .waiting_steps = 0}};
  }

  std::uint64_t step_{100};
  Pose waiting_;
  ConvexPolygon area_m_;
  std::unique_ptr<Controller> controller_;
};

TEST(Knot, ACarWithItsNoseAtTheKerbBesideAWaitingOneGetsAway) {
  BesideAWaitingCar one(kOwnPose, kWaitingPose);
  int steps = 0;
  for (; one.driven_m(kOwnPose) < 0.5 && steps < 60; ++steps) {
    one.step();
    EXPECT_TRUE(one.is_plan_free()) << steps;
    EXPECT_TRUE(one.keeps_to_its_lanes()) << steps;
  }
  EXPECT_LT(steps, 20);
}

TEST(Knot, WhereverTheTwoStandNoPlanMeetsTheOtherAndMostGetAway) {
  std::uint64_t num_cars = 0;
  std::uint64_t num_gone = 0;
  for (std::uint64_t seed = 0; seed < test::num_costly_seeds(5); ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937_64 random(seed);
    const Pose own = moved_at_random(kOwnPose, 0.004, 0.05, random);
    BesideAWaitingCar one(own, moved_at_random(kWaitingPose, 0.004, 0.05, random));
    one.step();
    if (!one.is_plan_free() || !one.keeps_to_its_lanes()) continue;
    ++num_cars;
    for (int i = 0; i < 20; ++i) {
      one.step();
      ASSERT_TRUE(one.is_plan_free()) << i;
    }
    num_gone += one.driven_m(own) > 0.5 ? 1U : 0U;
  }
  EXPECT_GT(num_cars, 0U);
  EXPECT_GT(2 * num_gone, num_cars) << num_gone << " of " << num_cars;
}

/// Steps all twenty cars, and checks how their plans end.
class CheckedRun {
 public:
  explicit CheckedRun(const scenario::Scenario& scenario) {
    const PreparedSubgraph on = scenario::prepare_subgraph_of(scenario);
    for (const scenario::ScenarioVehicle& vehicle : scenario.vehicles) {
      controllers_.push_back(scenario::make_controller(scenario, vehicle.id, on));
      Controller& one = *controllers_.back();
      static_cast<void>(one.stand_by(
          {.step = {0},
           .active = {vehicle.id},
           .states = {as_measured(vehicle.id, {.pose = vehicle.start}, one.subgraph().automaton())},
           .present = {}}));
      trackers_.emplace_back(
          std::make_shared<const std::vector<road::DrivableRoute>>(1, one.route()));
    }
  }

  void step(std::uint64_t step) {
    Observation observation{.step = {step}};
    std::vector<Controller*> controllers;
    std::vector<coordination::Plan> former;
    for (const auto& one : controllers_) {
      controllers.push_back(one.get());
      former.push_back(one->plan_in_force());
      observation.active.push_back(one->options().vehicle);
      observation.states.push_back(on_its_plan(*one, {step}));
    }
    observation.present = observation.active;
    static_cast<void>(joint_step(controllers, observation, {}));
    for (std::size_t i = 0; i < controllers.size(); ++i) {
      const coordination::Plan& plan = controllers_[i]->plan_in_force();
      trackers_[i].select_route(plan.pose_at({step}), car().footprint);
      EXPECT_TRUE(ends_along_lane(plan, former[i], {step + 1}, trackers_[i], 2.0))
          << "step " << step << ", vehicle " << i + 1;
    }
  }

 private:
  std::vector<std::unique_ptr<Controller>> controllers_;
  std::vector<RouteTracker> trackers_;
};

TEST(Knot, NoCarReplacesItsPlanByOneThatEndsAskewAndLeadsNowhere) {
  CheckedRun run(scenario::with_random_starts(lab_cars(), 1));
  for (std::uint64_t step = 1; step <= 60; ++step) run.step(step);
}

}  // namespace
}  // namespace hlc::controller::knot_test
