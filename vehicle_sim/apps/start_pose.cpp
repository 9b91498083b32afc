#include "vehicle_sim/apps/start_pose.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

namespace hlc::apps {
namespace {

/// The lab's, of vehicles 1 ... kLastDefaultStart.
constexpr std::array<Pose, kLastDefaultStart> kDefaultStarts{{
    {.x_m = 3.1575, .y_m = 3.8888, .heading_rad = -0.0502},
    {.x_m = 3.8795, .y_m = 3.7217, .heading_rad = -0.5016},
    {.x_m = 4.3584, .y_m = 2.9549, .heading_rad = -1.4108},
    {.x_m = 4.3950, .y_m = 2.0000, .heading_rad = -1.5708},
    {.x_m = 4.3584, .y_m = 1.0451, .heading_rad = -1.7307},
    {.x_m = 3.8795, .y_m = 0.2783, .heading_rad = -2.6400},
    {.x_m = 3.1575, .y_m = 0.1112, .heading_rad = -3.0914},
    {.x_m = 2.2500, .y_m = 0.1050, .heading_rad = 3.1416},
    {.x_m = 1.3425, .y_m = 0.1112, .heading_rad = 3.0914},
    {.x_m = 0.6205, .y_m = 0.2783, .heading_rad = 2.6400},
    {.x_m = 0.1416, .y_m = 1.0451, .heading_rad = 1.7307},
    {.x_m = 0.1050, .y_m = 2.0000, .heading_rad = 1.5708},
    {.x_m = 0.1416, .y_m = 2.9549, .heading_rad = 1.4108},
    {.x_m = 0.6205, .y_m = 3.7217, .heading_rad = 0.5016},
    {.x_m = 1.3425, .y_m = 3.8888, .heading_rad = 0.0502},
    {.x_m = 3.0500, .y_m = 2.2250, .heading_rad = 3.1416},
    {.x_m = 3.0500, .y_m = 1.7750, .heading_rad = 0.0000},
    {.x_m = 2.4750, .y_m = 1.2000, .heading_rad = 1.5708},
    {.x_m = 2.0250, .y_m = 1.2000, .heading_rad = -1.5708},
    {.x_m = 1.4500, .y_m = 1.7750, .heading_rad = 0.0000},
    {.x_m = 1.4500, .y_m = 2.2250, .heading_rad = 3.1416},
    {.x_m = 2.0250, .y_m = 2.8000, .heading_rad = -1.5708},
    {.x_m = 2.4750, .y_m = 2.8000, .heading_rad = 1.5708},
}};

}  // namespace

Pose start_pose(std::uint8_t vehicle_id, const std::vector<double>& given) {
  if (given.empty()) {
    if (vehicle_id > kLastDefaultStart) {
      throw std::invalid_argument(fmt::format(
          "--pose: vehicle {} has no default start pose; give x,y,yaw (only ids 1 ... {} "
          "can do without)",
          vehicle_id, kLastDefaultStart));
    }
    return kDefaultStarts.at(vehicle_id - 1U);
  }
  const bool is_finite =
      std::ranges::all_of(given, [](double value) { return std::isfinite(value); });
  if (given.size() != 3 || !is_finite) {
    throw std::invalid_argument("--pose: must be three finite numbers x,y,yaw [m, m, rad]");
  }
  return {.x_m = given[0], .y_m = given[1], .heading_rad = given[2]};
}

}  // namespace hlc::apps
