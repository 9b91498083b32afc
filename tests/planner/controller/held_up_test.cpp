#include "planner/controller/held_up.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include "planner/controller/controller.hpp"
#include "planner/controller/followed_plan.hpp"
#include "planner/controller/self_loop.hpp"
#include "planner/scenario/scenario.hpp"
#include "tests/planner/right_of_way/routes.hpp"
#include "tests/support/num_seeds.hpp"

namespace hlc::controller::held_up_test {
namespace {

using right_of_way::lab_cars;

const PreparedSubgraph& prepared() {
  static const PreparedSubgraph kPrepared = scenario::prepare_subgraph_of(lab_cars());
  return kPrepared;
}

/// A car of the lab that stands on its driving line, alone with what the second vehicle announces.
class HeldUp {
 public:
  HeldUp(VehicleId vehicle, double place_m)
      : controller_(scenario::make_controller(lab_cars(), vehicle, prepared())), own_(vehicle) {
    const scenario::ScenarioVehicle& car = scenario::vehicle_of(lab_cars(), vehicle);
    line_ = [&car](double s_m) { return car.driving_line.at(car.path, s_m); };
    const Point from_m = line_(place_m - 0.02);
    const Point to_m = line_(place_m + 0.02);
    const Pose start{line_(place_m).x(), line_(place_m).y(),
                     std::atan2((to_m - from_m).y(), (to_m - from_m).x())};
    static_cast<void>(controller_->stand_by(
        {.step = {step_}, .active = {own_}, .states = {measured(start)}, .present = {}}));
  }

  /// One step in which a vehicle that plans first keeps an area forever from t(next) on.
  void step(const ConvexPolygon& area_m) {
    ++step_;
    static_cast<void>(controller_->observe({.step = {step_},
                                            .active = {kFirst, own_},
                                            .states = {on_its_plan(*controller_, {step_})},
                                            .present = {kFirst, own_}}));
    coordination::Traffic traffic{.vehicle = kFirst, .step = {step_}};
    traffic.reachable_area_m = area_m;
    traffic.running = {.first = {step_}, .areas_m = {}, .final_area_m = kElsewhere};
    traffic.claim = coordination::LaneClaim{.route = kFarRoute};
    controller_->couple(std::vector{traffic});
    const coordination::Prediction prediction{
        .vehicle = kFirst,
        .step = {step_},
        .is_new = true,
        .areas = {.first = {step_ + 1}, .areas_m = {}, .final_area_m = area_m}};
    static_cast<void>(controller_->plan(std::vector{prediction}));
    static_cast<void>(controller_->commit(std::vector{prediction}, {}));
  }

  [[nodiscard]] const Controller& controller() const { return *controller_; }
  [[nodiscard]] Point line(double s_m) const { return line_(s_m); }
  [[nodiscard]] Pose end() const {
    const coordination::Plan& plan = controller_->plan_in_force();
    return plan.pose_at(std::max(plan.end(), StepIndex{step_ + 1}));
  }
  /// Of the plan's end, from the driving line.
  [[nodiscard]] double offset_m() const {
    double least_m = std::numeric_limits<double>::infinity();
    for (int i = 0; 0.005 * i < controller_->route().path.length_m(); ++i) {
      least_m = std::min(least_m, (line_(0.005 * i) - end().position_m()).norm());
    }
    return least_m;
  }

 private:
  static constexpr VehicleId kFirst{0};
  static constexpr std::uint32_t kFarRoute{0};
  inline static const ConvexPolygon kElsewhere{{{90, 90}, {91, 90}, {90, 91}}};

  [[nodiscard]] coordination::MeasuredVehicle measured(const Pose& pose) const {
    return as_measured(own_, {.pose = pose}, controller_->subgraph().automaton());
  }

  std::uint64_t step_{100};
  std::unique_ptr<Controller> controller_;
  VehicleId own_;
  std::function<Point(double)> line_;
};

/// A footprint over the lane ahead, beside its middle, so that there may seem to be a way past it.
ConvexPolygon intruder_m(const HeldUp& car, double s_m, double beside_m) {
  const Point along = (car.line(s_m + 0.02) - car.line(s_m - 0.02)).normalized();
  const Point centre_m = car.line(s_m) + beside_m * Point(-along.y(), along.x());
  return footprint_area(lab_cars().subgraph->automaton().vehicle.footprint,
                        {centre_m.x(), centre_m.y(), std::atan2(along.y(), along.x())}, 0.01);
}

/// A car of the lab and a place on its route, by seed.
class Draw {
 public:
  explicit Draw(std::uint64_t seed) : random_(seed) {}

  double uniform(double from, double to) {
    return std::uniform_real_distribution(from, to)(random_);
  }
  VehicleId vehicle() { return {static_cast<std::uint8_t>(1 + random_() % 20)}; }
  double place_m() { return uniform(1.0, 7.0); }

 private:
  std::mt19937_64 random_;
};

TEST(HeldUpCar, StaysInItsLaneBehindWhoeverReachesIntoIt) {
  const std::uint64_t num_cars = test::num_costly_seeds(30);
  std::uint64_t num_held_up = 0;
  for (std::uint64_t seed = 0; seed < num_cars; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Draw draw(seed);
    const VehicleId vehicle = draw.vehicle();
    const double place_m = draw.place_m();
    HeldUp car(vehicle, place_m);
    const ConvexPolygon area_m =
        intruder_m(car, place_m + draw.uniform(0.4, 0.6), draw.uniform(-0.06, 0.06));
    const Point start_m = car.controller().plan_in_force().pose_at({100}).position_m();
    for (int i = 0; i < 6; ++i) car.step(area_m);
    const double led_m = (car.end().position_m() - start_m).norm();
    if (led_m > 0.4) continue;  // it has passed
    ++num_held_up;
    EXPECT_LT(car.offset_m(), 0.030) << led_m;
  }
  EXPECT_GT(3 * num_held_up, num_cars) << num_held_up << " of " << num_cars;
}

/// Most of 300 such cars (seeds 0 to 299) never could: these do in one of their steps.
TEST(HeldUpCar, CreepsIfOnlyTheFirstPlanGetsOn) {
  const automaton::ReachableSets& reachable = *prepared().reachable;
  std::size_t num_creeping = 0;
  for (const std::uint64_t seed : {36U, 90U, 101U, 108U, 128U, 149U, 154U, 253U, 269U}) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Draw draw(seed);
    const VehicleId vehicle = draw.vehicle();
    const double place_m = draw.place_m();
    HeldUp car(vehicle, place_m);
    const double beside_m = draw.uniform(-0.16, 0.16);
    const ConvexPolygon area_m = intruder_m(car, place_m + draw.uniform(0.2, 0.6), beside_m);
    const auto led_m = [&](const SearchedProblem& searched) {
      const auto engine = search::make_search_engine(*searched.subgraph, reachable,
                                                     {.max_expansions = searched.max_expansions});
      const search::SearchResult found = engine->search(searched.problem);
      if (found.poses.empty()) return 0.0;
      return (found.poses.back().position_m() - searched.problem.start.position_m()).norm();
    };
    for (int i = 0; i < 8; ++i) {
      car.step(area_m);
      const auto problems = car.controller().problems();
      if (problems.size() != 2) continue;
      const double other_m = led_m(problems[0]);
      const double taken_m = led_m(problems[1]);
      EXPECT_TRUE(other_m < 1e-3 || taken_m > 1e-3) << "it stands, and could lead " << other_m;
      num_creeping += other_m < 1e-3 && taken_m > 1e-3 ? 1U : 0U;
    }
  }
  EXPECT_GT(num_creeping, 5U) << "nothing was tried";
}

/// Standing at arc length s of a ring of 12.6 m.
class HeldUpAt : public testing::Test {
 protected:
  [[nodiscard]] std::optional<double> at_m(double s_m, double reference_s_m) {
    const auto pose_on = [&](double at_m) {
      const Point point_m = tracker_.route().path.at(at_m);
      return Pose{point_m.x(), point_m.y(), tracker_.route().path.heading_rad_at(at_m)};
    };
    tracker_.select_route(pose_on(s_m - 0.3), {0.22, 0.107});
    const automaton::Subgraph& on = *lab_cars().subgraph;
    const coordination::Plan standing({1}, pose_on(s_m),
                                      self_loop(on.automaton(), on.standstill()));
    search::HorizonProblem problem;
    problem.reference_m.push_back(pose_on(reference_s_m).position_m());
    return held_up_at_m(standing, {1}, problem, tracker_, 2.0);
  }

  RouteTracker tracker_{std::make_shared<const std::vector<road::DrivableRoute>>(
      1, right_of_way::circle({0.0, 0.0}, 2.0))};
};

TEST_F(HeldUpAt, IsNoPlaceForAPlanThatGetsAboutAsFarAsTheReference) {
  EXPECT_FALSE(at_m(3.0, 3.0 + 0.9 * kHeldUp_m));
  EXPECT_FALSE(at_m(3.0, 2.9)) << "it gets farther";
}

TEST_F(HeldUpAt, IsWhereThePlanEndsCountedOnOverTheEndOfTheRoute) {
  EXPECT_NEAR(at_m(3.0, 4.0).value(), 3.0, 1e-3);
  const double length_m = tracker_.route().path.length_m();
  EXPECT_NEAR(at_m(0.1, 1.0).value(), length_m + 0.1, 1e-3);
  EXPECT_NEAR(at_m(length_m - 0.1, 0.5).value(), length_m - 0.1, 1e-3);
}

}  // namespace
}  // namespace hlc::controller::held_up_test
