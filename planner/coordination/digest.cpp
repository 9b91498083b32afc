#include "planner/coordination/digest.hpp"

#include "planner/common/word_hash.hpp"

namespace hlc::coordination {
namespace {

void add_number(WordHash& hash, std::uint64_t number) { hash.add(number); }

void add_pose(WordHash& hash, const Pose& pose) {
  hash.add(pose.x_m);
  hash.add(pose.y_m);
  hash.add(pose.heading_rad);
}

void add_area(WordHash& hash, const ConvexPolygon& area) {
  add_number(hash, area.vertices_m.size());
  for (const Point& vertex : area.vertices_m) {
    hash.add(vertex.x());
    hash.add(vertex.y());
  }
}

void add_areas(WordHash& hash, const OccupiedAreas& areas) {
  hash.add(areas.first.value);
  add_number(hash, areas.areas_m.size());
  for (const ConvexPolygon& area : areas.areas_m) add_area(hash, area);
  add_area(hash, areas.final_area_m);
}

void add_claim(WordHash& hash, const LaneClaim& claim) {
  add_number(hash, claim.route);
  hash.add(claim.place_m);
  hash.add(claim.ahead_m);
  add_number(hash, claim.waiting_steps);
}

void add_drivable_area(WordHash& hash, const DrivableAreaState& area) {
  add_number(hash, area.is_possible);
  add_number(hash, area.is_certain);
  add_number(hash, area.is_departing);
  add_number(hash, area.stands_since.has_value());
  hash.add(area.stands_since.value_or(StepIndex{}).value);
  add_number(hash, area.entry.has_value());
  const DrivableAreaState::Widened entry = area.entry.value_or(DrivableAreaState::Widened{});
  for (const double value : {entry.from_s_m, entry.to_s_m, entry.left_m, entry.right_m}) {
    hash.add(value);
  }
}

void add_planning_input(WordHash& hash, const PlanningInput& input) {
  hash.add(input.basis);
  add_number(hash, input.may_plan);
  hash.add(input.base.first.value);
  for (const Pose& pose : input.base.poses) add_pose(hash, pose);
  for (const std::uint32_t maneuver : input.base.maneuvers) add_number(hash, maneuver);
  add_number(hash, input.base.standstill);
  add_number(hash, input.is_moved);
  hash.add(input.seen_step.value);
  hash.add(input.seen_time_s);
  add_pose(hash, input.seen_pose);
  hash.add(input.deviation_m);
  add_number(hash, input.route);
  hash.add(input.path_s_m);
  add_drivable_area(hash, input.area);
}

}  // namespace

std::uint64_t digest_of(const Traffic& traffic) {
  WordHash hash;
  add_number(hash, traffic.vehicle.value);
  hash.add(traffic.step.value);
  add_pose(hash, traffic.next_pose);
  add_number(hash, traffic.next_trim.index);
  add_areas(hash, traffic.running);
  add_area(hash, traffic.reachable_area_m);
  add_number(hash, traffic.silent.size());
  for (const VehicleId vehicle : traffic.silent) add_number(hash, vehicle.value);
  add_number(hash, traffic.claim.has_value());
  if (traffic.claim) add_claim(hash, *traffic.claim);
  add_number(hash, traffic.planning.has_value());
  if (traffic.planning) add_planning_input(hash, *traffic.planning);
  return hash.value();
}

std::uint64_t digest_of(const Prediction& prediction) {
  WordHash hash;
  add_number(hash, prediction.vehicle.value);
  hash.add(prediction.step.value);
  add_number(hash, prediction.is_new);
  add_areas(hash, prediction.areas);
  add_number(hash, prediction.desired.has_value());
  if (prediction.desired) add_areas(hash, *prediction.desired);
  return hash.value();
}

}  // namespace hlc::coordination
