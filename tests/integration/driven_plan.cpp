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

}  // namespace hlc::test
