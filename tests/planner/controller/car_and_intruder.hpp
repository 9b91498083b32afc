#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <random>
#include <vector>

#include "planner/controller/controller.hpp"
#include "planner/controller/followed_plan.hpp"
#include "planner/scenario/scenario.hpp"

namespace hlc::controller {

/// A car of the scenario, which outlives this, that stands on its driving line, alone with what the
/// second vehicle announces.
class CarAndIntruder {
 public:
  CarAndIntruder(const scenario::Scenario& scenario, const PreparedSubgraph& prepared,
                 VehicleId vehicle, double place_m)
      : controller_(scenario::make_controller(scenario, vehicle, prepared)), own_(vehicle) {
    const scenario::ScenarioVehicle& car = scenario::vehicle_of(scenario, vehicle);
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
inline ConvexPolygon intruder_m(const CarAndIntruder& car, double s_m, double beside_m) {
  const Point along = (car.line(s_m + 0.02) - car.line(s_m - 0.02)).normalized();
  const Point centre_m = car.line(s_m) + beside_m * Point(-along.y(), along.x());
  return footprint_area(car.controller().subgraph().automaton().vehicle.footprint,
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

}  // namespace hlc::controller
