#include "tests/integration/driven_plan.hpp"

#include <algorithm>
#include <cmath>

#include "planner/coordination/missing.hpp"
#include "vehicle_sim/tracking/trajectory.hpp"

namespace hlc::test {
namespace {

Point position_m(const TrajectoryCommand& plan, Nanoseconds t) {
  const TrajectoryPoint& last = plan.points.back();
  if (t >= last.t) return {last.x_m, last.y_m};
  const auto now = tracking::sample(plan.points, t);
  return now ? now->position_m : Point{plan.points.front().x_m, plan.points.front().y_m};
}

}  // namespace

std::optional<double> farthest_from_plan_m(const result::Drive& drive, const Commands& commands,
                                           std::uint8_t vehicle, Nanoseconds from, Nanoseconds to) {
  const TrajectoryCommand* plan = nullptr;
  double farthest_m = 0.0;
  for (const result::DrivenSample& row : drive) {
    if (row.t < from || row.t > to) continue;
    if (plan == nullptr) {
      const auto found = commands.find({vehicle, row.command_create});
      if (found == commands.end() || !tracking::is_well_formed(found->second.points) ||
          found->second.points.size() < 2) {
        return std::nullopt;
      }
      plan = &found->second;
    }
    farthest_m = std::max(farthest_m, (row.pose.position_m() - position_m(*plan, row.t)).norm());
  }
  return plan == nullptr ? std::nullopt : std::optional{farthest_m};
}

std::optional<Nanoseconds> standing_since(const result::Drive& drive, Nanoseconds to) {
  std::optional<Nanoseconds> since;
  for (const result::DrivenSample& row : drive) {
    if (row.t > to) break;
    const bool stands =
        std::abs(row.speed_mps) <= coordination::MissingVehicleRules{}.standing_speed_mps;
    if (!stands) since.reset();
    if (stands && !since) since = row.t;
  }
  return since;
}

result::Encounters driven_encounters(const std::vector<result::VehicleDescription>& vehicles,
                                     const result::Drives& drives,
                                     const std::set<std::uint8_t>& ended) {
  const auto end_of = [&](const result::VehicleDescription& vehicle) {
    const auto drive = drives.find(vehicle.id.value);
    const bool ends = ended.contains(vehicle.id.value) && drive != drives.end();
    return ends && !drive->second.empty() ? drive->second.back().t : kForever;
  };
  result::Encounters all;
  for (std::size_t i = 0; i < vehicles.size(); ++i) {
    for (std::size_t j = i + 1; j < vehicles.size(); ++j) {
      const std::vector<result::VehicleDescription> pair{vehicles[i], vehicles[j]};
      const Nanoseconds to = std::min(end_of(pair.front()), end_of(pair.back()));
      const result::Encounters of_pair = result::encounters(pair, drives, 0, to);
      all.collisions += of_pair.collisions;
      if (!of_pair.min_distance_m) continue;
      all.min_distance_m =
          std::min(all.min_distance_m.value_or(*of_pair.min_distance_m), *of_pair.min_distance_m);
    }
  }
  return all;
}

}  // namespace hlc::test
