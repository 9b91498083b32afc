#include "hlc_bridge/dds/convert_planning.hpp"

#include <algorithm>
#include <vector>

// The structured bindings name every field of a plain message, so that a new field does not compile
// until it is converted.
namespace hlc::dds {

PoseMessage pose_to_wire(const Pose& pose) {
  PoseMessage result;
  result.x_m(pose.x_m);
  result.y_m(pose.y_m);
  result.heading_rad(pose.heading_rad);
  return result;
}

Pose pose_from_wire(const PoseMessage& wire) {
  return {wire.x_m(), wire.y_m(), wire.heading_rad()};
}

namespace {

void plan_to_wire(const coordination::PlanByIndex& plan, PlanningInputMessage& wire) {
  const auto& [first, poses, maneuvers, standstill] = plan;
  wire.base_first(first.value);
  for (const Pose& pose : poses) wire.base_poses().push_back(pose_to_wire(pose));
  wire.base_maneuvers(maneuvers);
  wire.base_standstill(standstill);
}

coordination::PlanByIndex plan_from_wire(const PlanningInputMessage& wire) {
  coordination::PlanByIndex plan{.first = {wire.base_first()},
                                 .poses = {},
                                 .maneuvers = wire.base_maneuvers(),
                                 .standstill = wire.base_standstill()};
  for (const PoseMessage& pose : wire.base_poses()) plan.poses.push_back(pose_from_wire(pose));
  return plan;
}

void area_to_wire(const coordination::DrivableAreaState& area, PlanningInputMessage& wire) {
  const auto& [entry, is_possible, is_certain, is_departing, stands_since] = area;
  const auto& [from_s_m, to_s_m, left_m, right_m] =
      entry.value_or(coordination::DrivableAreaState::Widened{});
  wire.enters_lanes(entry.has_value());
  wire.entry_from_s_m(from_s_m);
  wire.entry_to_s_m(to_s_m);
  wire.entry_left_m(left_m);
  wire.entry_right_m(right_m);
  wire.entry_is_possible(is_possible);
  wire.entry_is_certain(is_certain);
  wire.is_departing(is_departing);
  wire.stands(stands_since.has_value());
  wire.stands_since(stands_since.value_or(StepIndex{}).value);
}

coordination::DrivableAreaState area_from_wire(const PlanningInputMessage& wire) {
  coordination::DrivableAreaState area{.entry = std::nullopt,
                                       .is_possible = wire.entry_is_possible(),
                                       .is_certain = wire.entry_is_certain(),
                                       .is_departing = wire.is_departing(),
                                       .stands_since = std::nullopt};
  if (wire.enters_lanes()) {
    area.entry = {.from_s_m = wire.entry_from_s_m(),
                  .to_s_m = wire.entry_to_s_m(),
                  .left_m = wire.entry_left_m(),
                  .right_m = wire.entry_right_m()};
  }
  if (wire.stands()) area.stands_since = StepIndex{wire.stands_since()};
  return area;
}

}  // namespace

PlanningInputMessage planning_to_wire(const coordination::PlanningInput& input) {
  const auto& [basis, may_plan, base, is_moved, seen_step, seen_time_s, seen_pose, deviation_m,
               route, path_s_m, area] = input;
  PlanningInputMessage wire;
  wire.basis(basis);
  wire.may_plan(may_plan);
  plan_to_wire(base, wire);
  wire.is_moved(is_moved);
  wire.seen_step(seen_step.value);
  wire.seen_time_s(seen_time_s);
  wire.seen_pose(pose_to_wire(seen_pose));
  wire.deviation_m(deviation_m);
  wire.route(route);
  wire.path_s_m(path_s_m);
  area_to_wire(area, wire);
  return wire;
}

bool is_valid(const PlanningInputMessage& wire) {
  return wire.base_poses().size() <= kMaxEntries && wire.base_maneuvers().size() <= kMaxEntries &&
         std::ranges::all_of(
             wire.base_poses(),
             [](const PoseMessage& pose) { return is_finite(pose_from_wire(pose)); }) &&
         is_finite(pose_from_wire(wire.seen_pose())) &&
         all_finite(wire.seen_time_s(), wire.deviation_m(), wire.path_s_m()) &&
         (!wire.enters_lanes() || all_finite(wire.entry_from_s_m(), wire.entry_to_s_m(),
                                             wire.entry_left_m(), wire.entry_right_m()));
}

coordination::PlanningInput planning_from_wire(const PlanningInputMessage& wire) {
  return {.basis = wire.basis(),
          .may_plan = wire.may_plan(),
          .base = plan_from_wire(wire),
          .is_moved = wire.is_moved(),
          .seen_step = {wire.seen_step()},
          .seen_time_s = wire.seen_time_s(),
          .seen_pose = pose_from_wire(wire.seen_pose()),
          .deviation_m = wire.deviation_m(),
          .route = wire.route(),
          .path_s_m = wire.path_s_m(),
          .area = area_from_wire(wire)};
}

}  // namespace hlc::dds
