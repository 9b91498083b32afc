#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "planner/controller/route_tracker.hpp"
#include "planner/coordination/messages.hpp"
#include "planner/coordination/plan.hpp"
#include "planner/right_of_way/conflict_map.hpp"
#include "tests/planner/automaton/paper_automaton.hpp"
#include "tests/planner/right_of_way/routes.hpp"

/// A closed road of one route, and vehicles on it, for tests of the right of way of one of them.
namespace hlc::controller {

inline const vehicle::VehicleParameters& car() { return automaton::paper_automaton()->vehicle; }

/// A ring of 12.6 m and what vehicles on it plan.
class Ring {
 public:
  explicit Ring(const road::DrivableRoute& route = right_of_way::circle({0.0, 0.0}, 2.0),
                double s_m = 0.0)
      : tracker(std::make_shared<const std::vector<road::DrivableRoute>>(1, route)) {
    tracker.select_route(pose_on(s_m), car().footprint);
  }

  [[nodiscard]] const road::ReferencePath& path() const { return tracker.route().path; }
  [[nodiscard]] Pose pose_on(double s_m) const {
    const Point point_m = path().at(s_m);
    return {point_m.x(), point_m.y(), path().heading_rad_at(s_m)};
  }
  [[nodiscard]] static const automaton::Maneuver& edge(std::size_t from, std::size_t to) {
    return *automaton::paper_automaton()->find({from}, {to}, from == to ? "trim" : "J2");
  }
  /// Standing at arc length s from step 1 on.
  [[nodiscard]] coordination::Plan standing(double s_m) const {
    return {{1}, pose_on(s_m), edge(0, 0)};
  }
  /// Standing there until step 3, then driving 0.32 m until step 6.
  [[nodiscard]] coordination::Plan driving(double s_m) const {
    return standing(s_m).continued({3}, {&edge(0, 6), &edge(6, 6), &edge(6, 0)});
  }
  [[nodiscard]] static coordination::Traffic other_at(std::uint8_t vehicle, double s_m,
                                                      double ahead_m = 0.0) {
    return {.vehicle = {vehicle},
            .claim = coordination::LaneClaim{.place_m = s_m, .ahead_m = ahead_m}};
  }

  RouteTracker tracker;
  std::shared_ptr<const right_of_way::ConflictMap> map{
      std::make_shared<const right_of_way::ConflictMap>(tracker.routes(), car())};
};

}  // namespace hlc::controller
