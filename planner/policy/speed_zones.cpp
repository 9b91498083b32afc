#include "planner/policy/speed_zones.hpp"

#include <algorithm>
#include <cmath>

namespace hlc::policy {
namespace {

constexpr double kInterval_m = 0.01;

bool contains(const SpeedZone& zone, const Point& position_m) {
  return position_m.x() >= zone.min_x_m && position_m.x() <= zone.max_x_m &&
         position_m.y() >= zone.min_y_m && position_m.y() <= zone.max_y_m;
}

}  // namespace

std::vector<double> limits_mps(std::span<const SpeedZone> zones) {
  std::vector<double> limits;
  for (const SpeedZone& zone : zones) limits.push_back(zone.max_speed_mps);
  std::ranges::sort(limits);
  limits.erase(std::unique(limits.begin(), limits.end()), limits.end());
  return limits;
}

std::optional<double> limit_at(std::span<const SpeedZone> zones, const Point& position_m) {
  std::optional<double> limit;
  for (const SpeedZone& zone : zones) {
    if (limit && *limit <= zone.max_speed_mps) continue;
    if (contains(zone, position_m)) limit = zone.max_speed_mps;
  }
  return limit;
}

std::optional<double> limit_on(std::span<const SpeedZone> zones, const road::ReferencePath& path,
                               double s_m, double ahead_m) {
  std::optional<double> limit;
  if (zones.empty()) return limit;
  const int intervals = static_cast<int>(std::ceil(ahead_m / kInterval_m));
  for (int i = 0; i <= intervals; ++i) {
    const auto here = limit_at(zones, path.at(s_m + std::min(i * kInterval_m, ahead_m)));
    if (here) limit = std::min(*here, limit.value_or(*here));
  }
  return limit;
}

}  // namespace hlc::policy
