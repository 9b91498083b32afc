#include "vehicle_sim/apps/start_pose.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace hlc::apps {
namespace {

constexpr int kColumns = 6;

Pose grid_pose(std::uint8_t vehicle_id) {
  const int index = vehicle_id - 1;
  return {.x_m = 0.5 + 0.7 * (index % kColumns),
          .y_m = 0.5 + 1.0 * (index / kColumns),
          .heading_rad = 0.0};
}

}  // namespace

Pose start_pose(std::uint8_t vehicle_id, const std::vector<double>& given) {
  if (given.empty()) {
    if (vehicle_id > kLastDefaultStart) {
      throw std::invalid_argument(fmt::format(
          "--pose: vehicle {} has no default start pose; give x,y,yaw (only ids 1 ... {} "
          "can do without)",
          vehicle_id, kLastDefaultStart));
    }
    return grid_pose(vehicle_id);
  }
  const bool is_finite =
      std::ranges::all_of(given, [](double value) { return std::isfinite(value); });
  if (given.size() != 3 || !is_finite) {
    throw std::invalid_argument("--pose: must be three finite numbers x,y,yaw [m, m, rad]");
  }
  return {.x_m = given[0], .y_m = given[1], .heading_rad = given[2]};
}

}  // namespace hlc::apps
