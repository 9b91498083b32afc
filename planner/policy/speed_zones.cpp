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

std::optional<std::size_t> least_zone_at(std::span<const SpeedZone> zones,
                                         const Point& position_m) {
  std::optional<std::size_t> least;
  for (std::size_t i = 0; i < zones.size(); ++i) {
    if (least && zones[*least].max_speed_mps <= zones[i].max_speed_mps) continue;
    if (contains(zones[i], position_m)) least = i;
  }
  return least;
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
  const std::optional<std::size_t> zone = least_zone_at(zones, position_m);
  if (!zone) return std::nullopt;
  return zones[*zone].max_speed_mps;
}

std::optional<std::size_t> least_zone_on(std::span<const SpeedZone> zones,
                                         const road::ReferencePath& path, double s_m,
                                         double ahead_m) {
  std::optional<std::size_t> least;
  if (zones.empty()) return least;
  const int intervals = static_cast<int>(std::ceil(ahead_m / kInterval_m));
  for (int i = 0; i <= intervals; ++i) {
    const auto here = least_zone_at(zones, path.at(s_m + std::min(i * kInterval_m, ahead_m)));
    if (here && (!least || zones[*here].max_speed_mps < zones[*least].max_speed_mps)) least = here;
  }
  return least;
}

std::optional<double> limit_on(std::span<const SpeedZone> zones, const road::ReferencePath& path,
                               double s_m, double ahead_m) {
  const std::optional<std::size_t> zone = least_zone_on(zones, path, s_m, ahead_m);
  if (!zone) return std::nullopt;
  return zones[*zone].max_speed_mps;
}

}  // namespace hlc::policy
