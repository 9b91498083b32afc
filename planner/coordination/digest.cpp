#include "planner/coordination/digest.hpp"

#include <cstdint>
#include <optional>
#include <vector>

#include "planner/common/word_hash.hpp"

// The structured bindings name every field, so that a new one does not compile until it is in the
// digest: safety rests on equal digests for equal predictions only (controller/two_rounds.hpp).
namespace hlc::coordination {
namespace {

template <class Value>
void add(WordHash& hash, const std::vector<Value>& values);
template <class Value>
void add(WordHash& hash, const std::optional<Value>& value);

void add(WordHash& hash, std::uint64_t number) { hash.add(number); }
void add(WordHash& hash, std::uint32_t number) { hash.add(std::uint64_t{number}); }
void add(WordHash& hash, bool yes) { hash.add(std::uint64_t{yes}); }
void add(WordHash& hash, double number) { hash.add(number); }
void add(WordHash& hash, const VehicleId& vehicle) { hash.add(std::uint64_t{vehicle.value}); }
void add(WordHash& hash, const StepIndex& step) { hash.add(step.value); }

void add(WordHash& hash, const Point& point) {
  hash.add(point.x());
  hash.add(point.y());
}

void add(WordHash& hash, const Pose& pose) {
  const auto& [x_m, y_m, heading_rad] = pose;
  for (const double value : {x_m, y_m, heading_rad}) hash.add(value);
}

void add(WordHash& hash, const ConvexPolygon& area) {
  const auto& [vertices_m] = area;
  hash.add(std::uint64_t{vertices_m.size()});
  for (const Point& vertex : vertices_m) add(hash, vertex);
}

void add(WordHash& hash, const OccupiedAreas& areas) {
  const auto& [first, areas_m, final_area_m] = areas;
  add(hash, first);
  add(hash, areas_m);
  add(hash, final_area_m);
}

void add(WordHash& hash, const LaneClaim& claim) {
  const auto& [route, place_m, ahead_m, waiting_steps] = claim;
  add(hash, route);
  add(hash, place_m);
  add(hash, ahead_m);
  add(hash, waiting_steps);
}

void add(WordHash& hash, const DrivableAreaState::Widened& widened) {
  const auto& [from_s_m, to_s_m, left_m, right_m] = widened;
  for (const double value : {from_s_m, to_s_m, left_m, right_m}) hash.add(value);
}

void add(WordHash& hash, const DrivableAreaState& area) {
  const auto& [entry, is_possible, is_certain, is_departing, stands_since] = area;
  add(hash, entry);
  for (const bool yes : {is_possible, is_certain, is_departing}) add(hash, yes);
  add(hash, stands_since);
}

void add(WordHash& hash, const PlanByIndex& plan) {
  const auto& [first, poses, maneuvers, standstill] = plan;
  add(hash, first);
  add(hash, poses);
  add(hash, maneuvers);
  add(hash, standstill);
}

void add(WordHash& hash, const PlanningInput& input) {
  const auto& [basis, may_plan, base, is_moved, seen_step, seen_time_s, seen_pose, deviation_m,
               route, path_s_m, area] = input;
  add(hash, basis);
  add(hash, may_plan);
  add(hash, base);
  add(hash, is_moved);
  add(hash, seen_step);
  add(hash, seen_time_s);
  add(hash, seen_pose);
  add(hash, deviation_m);
  add(hash, route);
  add(hash, path_s_m);
  add(hash, area);
}

template <class Value>
void add(WordHash& hash, const std::vector<Value>& values) {
  hash.add(std::uint64_t{values.size()});
  for (const Value& value : values) add(hash, value);
}

template <class Value>
void add(WordHash& hash, const std::optional<Value>& value) {
  add(hash, value.has_value());
  if (value) add(hash, *value);
}

}  // namespace

std::uint64_t digest_of(const Traffic& traffic) {
  const auto& [vehicle, step, next_pose, next_trim, running, reachable_area_m, silent,
               standing_steps, reference_areas_m, claim, planning] = traffic;
  WordHash hash;
  add(hash, vehicle);
  add(hash, step);
  add(hash, next_pose);
  add(hash, std::uint64_t{next_trim.index});
  add(hash, running);
  add(hash, reachable_area_m);
  add(hash, silent);
  add(hash, standing_steps);
  add(hash, reference_areas_m);
  add(hash, claim);
  add(hash, planning);
  return hash.value();
}

std::uint64_t digest_of(const Prediction& prediction) {
  const auto& [vehicle, step, is_new, areas, desired] = prediction;
  WordHash hash;
  add(hash, vehicle);
  add(hash, step);
  add(hash, is_new);
  add(hash, areas);
  add(hash, desired);
  return hash.value();
}

}  // namespace hlc::coordination
