#pragma once

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "planner/right_of_way/conflict_map.hpp"
#include "planner/scenario/scenario.hpp"
#include "tests/support/folders.hpp"

/// Closed routes whose conflicts are known, and those of the lab.
namespace hlc::right_of_way {

/// Of the lab's car.
inline constexpr vehicle::VehicleParameters kCar{.rear_axle_to_cg_m = 0.045};
inline constexpr double kLane_m = 0.150;

inline road::DrivableRoute route_along(std::vector<Point> points_m) {
  return {.name = {}, .path = {std::move(points_m), true}, .corridor = {}};
}

/// @param turns  1: counter-clockwise, -1: clockwise
inline road::DrivableRoute circle(const Point& centre_m, double radius_m, double turns = 1.0) {
  std::vector<Point> points_m;
  for (int i = 0; i < 720; ++i) {
    const double angle_rad = turns * std::numbers::pi * i / 360.0;
    points_m.push_back(centre_m + radius_m * Point(std::cos(angle_rad), std::sin(angle_rad)));
  }
  return route_along(std::move(points_m));
}

/// Crosses itself in the origin, at a right angle.
inline road::DrivableRoute figure_eight() {
  std::vector<Point> points_m;
  for (int i = 0; i < 1440; ++i) {
    const double t = std::numbers::pi * i / 720.0;
    points_m.emplace_back(2.0 * std::sin(t), 2.0 * std::sin(t) * std::cos(t));
  }
  return route_along(std::move(points_m));
}

/// Up the straight lane from (0, -1) to (0, 1), then back on a loop to the left (1) or right (-1).
inline road::DrivableRoute loop_beside_lane(double side) {
  std::vector<Point> points_m;
  const auto straight = [&](double x_m, double up) {
    for (int i = 0; i < 50; ++i) points_m.emplace_back(x_m, up * (-1.0 + 0.04 * i));
  };
  const auto half_circle = [&](double up) {
    for (int i = 0; i < 90; ++i) {
      const double angle_rad = std::numbers::pi * i / 90.0;
      points_m.emplace_back(-side * (0.6 - up * 0.6 * std::cos(angle_rad)),
                            up * (1.0 + 0.6 * std::sin(angle_rad)));
    }
  };
  straight(0.0, 1.0);
  half_circle(1.0);
  straight(-side * 1.2, -1.0);
  half_circle(-1.0);
  return route_along(std::move(points_m));
}

/// 20 cars drawn on the lab's road network.
inline const scenario::Scenario& lab_cars() {
  static const scenario::Scenario kScenario = scenario::read_scenario(
      {.file = test::source_folder() + "/launch_scripts/scenarios/lab_cars.yaml"});
  return kScenario;
}

/// The same with random turns, which takes seconds to read: once for all tests of a program.
inline const scenario::Scenario& lab_cars_on_tours() {
  static const scenario::Scenario kScenario = scenario::read_scenario(
      {.file = test::source_folder() + "/launch_scripts/scenarios/lab_cars.yaml",
       .seed = 2,
       .routes = "random"});
  return kScenario;
}

}  // namespace hlc::right_of_way
