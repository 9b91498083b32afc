#include "planner/right_of_way/conflict_map.hpp"

#include <algorithm>
#include <cmath>

#include "planner/common/demand.hpp"
#include "planner/geometry/near_points.hpp"
#include "planner/road/driving_line.hpp"

namespace hlc::right_of_way {
namespace {

constexpr double kHalfChord_m = 0.05;
constexpr double kCurvatureChord_m = 0.06;
/// Half the steering lock of any vehicle that this is for; a spike of a polyline's curvature must
/// not turn the rectangle farther.
constexpr double kMostSlip = 0.9;

}  // namespace

ConflictMap::ConflictMap(std::span<const road::DrivableRoute> routes,
                         const vehicle::VehicleParameters& vehicle, const ConflictRules& rules) {
  for (const road::DrivableRoute& route : routes) add_route(route, vehicle, rules);
  std::vector<CellName> names;
  NearPoints near(2.0 * reach_of_area_m_);
  for (std::size_t route = 0; route < routes_.size(); ++route) {
    for (std::size_t cell = 0; cell < routes_[route].size(); ++cell) {
      names.push_back({route, cell});
      near.add(routes_[route][cell].pose.position_m());
    }
  }
  std::vector<CellName> beside;
  for (const CellName& name : names) {
    Cell& cell = routes_[name.route][name.cell];
    cell.overlaps.resize(routes_.size());
    beside.clear();
    near.visit(cell.pose.position_m(), [&](std::size_t i) { beside.push_back(names[i]); });
    relate(cell, name.route, beside, rules);
  }
}

void ConflictMap::add_route(const road::DrivableRoute& route,
                            const vehicle::VehicleParameters& vehicle, const ConflictRules& rules) {
  HLC_DEMAND(route.path.is_closed());
  const double length_m = route.path.length_m();
  const auto count = static_cast<std::size_t>(std::max(1.0, std::round(length_m / rules.cell_m)));
  const Footprint footprint{vehicle.footprint.length_m + 2.0 * rules.along_m,
                            vehicle.footprint.width_m + 2.0 * rules.across_m};
  reach_of_area_m_ = std::hypot(footprint.length_m, footprint.width_m) / 2.0;
  std::vector<Cell> cells;
  for (std::size_t i = 0; i < count; ++i) {
    const double s_m = length_m * static_cast<double>(i) / static_cast<double>(count);
    const Point point_m = route.driving_line.at(route.path, s_m);
    const Pose pose{point_m.x(), point_m.y(),
                    road::chord_heading_rad(route.path, s_m, kHalfChord_m)};
    const double slip =
        vehicle.rear_axle_to_cg_m * road::chord_curvature_per_m(route.path, s_m, kCurvatureChord_m);
    Pose turned = pose;
    turned.heading_rad -= std::asin(std::clamp(slip, -kMostSlip, kMostSlip));
    cells.push_back({.pose = pose, .area_m = footprint_area(footprint, turned)});
  }
  routes_.push_back(std::move(cells));
  lengths_m_.push_back(length_m);
}

std::size_t ConflictMap::cells_apart(std::size_t route, std::size_t a, std::size_t b) const {
  const std::size_t apart = a > b ? a - b : b - a;
  return std::min(apart, num_cells(route) - apart);
}

void ConflictMap::relate(Cell& cell, std::size_t route, const std::vector<CellName>& near,
                         const ConflictRules& rules) const {
  std::vector<std::vector<std::size_t>> same(routes_.size());
  for (const CellName& name : near) {
    const Cell& other = routes_[name.route][name.cell];
    const double apart_m = (cell.pose.position_m() - other.pose.position_m()).norm();
    const double turned_rad = wrap_angle(cell.pose.heading_rad - other.pose.heading_rad);
    const bool is_same = name.route == route ? &other == &cell
                                             : apart_m < rules.same_place_m &&
                                                   std::abs(turned_rad) < rules.same_heading_rad;
    if (is_same) same[name.route].push_back(name.cell);
    if (intersects(cell.area_m, other.area_m)) {
      cell.overlaps[name.route].push_back(static_cast<std::uint32_t>(name.cell));
    }
  }
  for (std::size_t other = 0; other < routes_.size(); ++other) {
    std::ranges::sort(cell.overlaps[other]);
    const auto following = static_cast<std::size_t>(rules.following_m / cell_m(other));
    cell.is_conflict |= std::ranges::any_of(cell.overlaps[other], [&](std::size_t j) {
      return std::ranges::none_of(
          same[other], [&](std::size_t k) { return cells_apart(other, j, k) <= following; });
    });
  }
}

}  // namespace hlc::right_of_way
