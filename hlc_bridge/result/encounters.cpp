#include "hlc_bridge/result/encounters.hpp"

#include <algorithm>
#include <cmath>

#include "planner/geometry/polygon.hpp"

namespace hlc::result {
namespace {

double radius_m(const Footprint& footprint) {
  return 0.5 * std::hypot(footprint.length_m, footprint.width_m);
}

/// Instants within [from, to] of either drive, increasing.
std::vector<Nanoseconds> instants(const Drive& a, const Drive& b, Nanoseconds from,
                                  Nanoseconds to) {
  std::vector<Nanoseconds> times;
  for (const Drive* drive : {&a, &b}) {
    for (const DrivenSample& sample : *drive) {
      if (sample.t >= from && sample.t <= to) {
        times.push_back(sample.t);
      }
    }
  }
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

double distance_of(const Footprint& a, const Pose& pose_a, const Footprint& b, const Pose& pose_b) {
  return distance_m(footprint_area(a, pose_a), footprint_area(b, pose_b));
}

void measure_pair(const VehicleDescription& a, const Drive& drive_a, const VehicleDescription& b,
                  const Drive& drive_b, Nanoseconds from, Nanoseconds to, Encounters& result) {
  bool touched = false;
  for (const Nanoseconds t : instants(drive_a, drive_b, from, to)) {
    const std::optional<Pose> pose_a = driven_pose_at(drive_a, t);
    const std::optional<Pose> pose_b = driven_pose_at(drive_b, t);
    if (!pose_a || !pose_b) {
      continue;
    }
    // The distance of the circles around the footprints is a lower bound.
    const double bound_m = (pose_a->position_m() - pose_b->position_m()).norm() -
                           radius_m(a.footprint) - radius_m(b.footprint);
    if (result.min_distance_m && bound_m > *result.min_distance_m && bound_m > 0.0) {
      touched = false;
      continue;
    }
    const double d_m = distance_of(a.footprint, *pose_a, b.footprint, *pose_b);
    result.min_distance_m = std::min(result.min_distance_m.value_or(d_m), d_m);
    const bool touches = d_m == 0.0;
    result.collisions += touches && !touched ? 1U : 0U;
    touched = touches;
  }
}

void measure_obstacle(const Footprint& footprint, const Drive& drive, const Obstacle& obstacle,
                      Nanoseconds from, Nanoseconds to, Encounters& result) {
  bool touched = false;
  for (const DrivenSample& sample : drive) {
    if (sample.t < from || sample.t > to) continue;
    const double d_m = distance_m(footprint_area(footprint, sample.pose), obstacle.area_m);
    result.min_distance_m = std::min(result.min_distance_m.value_or(d_m), d_m);
    const bool touches = d_m == 0.0;
    result.collisions += touches && !touched ? 1U : 0U;
    touched = touches;
  }
}

}  // namespace

Encounters encounters(std::span<const VehicleDescription> vehicles, const Drives& drives,
                      Nanoseconds from, Nanoseconds to) {
  Encounters result;
  for (std::size_t i = 0; i < vehicles.size(); ++i) {
    for (std::size_t j = i + 1; j < vehicles.size(); ++j) {
      const auto drive_i = drives.find(vehicles[i].id.value);
      const auto drive_j = drives.find(vehicles[j].id.value);
      if (drive_i != drives.end() && drive_j != drives.end()) {
        measure_pair(vehicles[i], drive_i->second, vehicles[j], drive_j->second, from, to, result);
      }
    }
  }
  return result;
}

Encounters encounters_with(std::span<const Obstacle> obstacles,
                           std::span<const VehicleDescription> vehicles, const Drives& drives,
                           Nanoseconds step0, Nanoseconds period, Nanoseconds to) {
  Encounters result;
  for (const VehicleDescription& vehicle : vehicles) {
    const auto drive = drives.find(vehicle.id.value);
    if (drive == drives.end()) continue;
    for (const Obstacle& one : obstacles) {
      measure_obstacle(vehicle.footprint, drive->second, one, step0 + one.from * period, to,
                       result);
    }
  }
  return result;
}

std::vector<TimedDistance> footprint_distances(const VehicleDescription& a, const Drive& drive_a,
                                               const VehicleDescription& b, const Drive& drive_b,
                                               Nanoseconds from, Nanoseconds to) {
  std::vector<TimedDistance> distances;
  for (const Nanoseconds t : instants(drive_a, drive_b, from, to)) {
    const std::optional<Pose> pose_a = driven_pose_at(drive_a, t);
    const std::optional<Pose> pose_b = driven_pose_at(drive_b, t);
    if (!pose_a || !pose_b) continue;
    distances.push_back({t, distance_of(a.footprint, *pose_a, b.footprint, *pose_b)});
  }
  return distances;
}

}  // namespace hlc::result
