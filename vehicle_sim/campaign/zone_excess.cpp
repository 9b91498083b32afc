#include "vehicle_sim/campaign/zone_excess.hpp"

#include <algorithm>
#include <cmath>

#include "planner/policy/speed_zones.hpp"

namespace hlc::campaign {

std::optional<ZoneExcess> zone_excess(std::span<const policy::SpeedZone> zones,
                                      const result::Drives& drives, const result::RunFacts& facts) {
  const Nanoseconds from = facts.first_step.value_or(0) * facts.period;
  const Nanoseconds to = from + facts.steps * facts.period;
  std::size_t inside = 0;
  std::size_t above = 0;
  std::size_t clearly_above = 0;
  ZoneExcess excess;
  for (const auto& [vehicle, drive] : drives) {
    for (const result::DrivenSample& sample : drive) {
      if (sample.t < from || sample.t > to) continue;
      const std::optional<double> limit_mps = policy::limit_at(zones, sample.pose.position_m());
      if (!limit_mps) continue;
      ++inside;
      const double excess_mps = std::abs(sample.speed_mps) - *limit_mps;
      if (excess_mps <= 0.0) continue;
      ++above;
      if (excess_mps > kFollowerExcess_mps) ++clearly_above;
      excess.max_mps = std::max(excess.max_mps, excess_mps);
    }
  }
  if (inside == 0) return std::nullopt;
  const auto share_of = [&](std::size_t ticks) {
    return static_cast<double>(ticks) / static_cast<double>(inside);
  };
  excess.share = share_of(above);
  excess.clear_share = share_of(clearly_above);
  return excess;
}

}  // namespace hlc::campaign
