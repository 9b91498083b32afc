#include "planner/right_of_way/conflict_map.hpp"

#include <algorithm>
#include <cmath>

#include "planner/common/demand.hpp"
#include "planner/road/driving_line.hpp"

namespace hlc::right_of_way {
namespace {

// Lengths for the µCar, as ConflictRules.
constexpr double kHalfChord_m = 0.05;
constexpr double kCurvatureChord_m = 0.06;
/// Half the steering lock of any vehicle that this is for; a spike of a polyline's curvature must
/// not turn the rectangle farther.
constexpr double kMostSlip = 0.9;
/// Joined cells lie across the lane, and are turned, by less than this from each other.
constexpr double kSameLane_m = 0.004;
constexpr double kSameLane_rad = 0.1;

ConflictRules scaled(const ConflictRules& rules, double scale) {
  return {.cell_m = scale * rules.cell_m,
          .across_m = scale * rules.across_m,
          .along_m = scale * rules.along_m,
          .same_place_m = scale * rules.same_place_m,
          .same_heading_rad = rules.same_heading_rad,
          .following_m = scale * rules.following_m,
          .joined_m = scale * rules.joined_m,
          .shares_conflicts = rules.shares_conflicts,
          .stopping_room_m = scale * rules.stopping_room_m};
}

}  // namespace

ConflictMap::ConflictMap(std::span<const road::DrivableRoute> routes,
                         const vehicle::VehicleParameters& vehicle,
                         const ConflictRules& for_the_ucar)
    : scale_(scale_of(vehicle.footprint)) {
  const ConflictRules rules = scaled(for_the_ucar, scale_);
  stopping_room_m_ = rules.stopping_room_m;
  reach_of_area_m_ =
      std::hypot(vehicle.footprint.length_m + 2.0 * rules.along_m,
                 vehicle.footprint.width_m + 2.0 * (rules.across_m + rules.stopping_room_m)) /
      2.0;
  NearPoints near(2.0 * reach_of_area_m_);
  for (const road::DrivableRoute& route : routes) add_route(route, vehicle, rules, near);
  for (std::size_t route = 0; route < routes_.size(); ++route) add_lanes(route, rules);
  Numbers beside;
  for (Cell& cell : cells_) {
    beside.clear();
    near.visit(cell.pose.position_m(), [&](std::uint32_t i) { beside.push_back(i); });
    std::ranges::sort(beside);
    relate(cell, beside, rules);
  }
  if (rules.shares_conflicts) share_conflicts();
  for (Cell& cell : cells_) {
    cell.lanes.clear();
    cell.same_place.clear();
    cell.stopping_area_m = {};
  }
}

std::int64_t ConflictMap::count_at(std::size_t route, double s_m) const {
  return std::llround(s_m / cell_m(route));
}

std::size_t ConflictMap::index_of(std::size_t route, std::int64_t count) const {
  const auto whole_route = static_cast<std::int64_t>(num_cells(route));
  return static_cast<std::size_t>((count % whole_route + whole_route) % whole_route);
}

void ConflictMap::add_route(const road::DrivableRoute& route,
                            const vehicle::VehicleParameters& vehicle, const ConflictRules& rules,
                            NearPoints& near) {
  HLC_DEMAND(route.path.is_closed());
  const double length_m = route.path.length_m();
  const auto count = static_cast<std::size_t>(std::max(1.0, std::round(length_m / rules.cell_m)));
  const Footprint footprint{vehicle.footprint.length_m + 2.0 * rules.along_m,
                            vehicle.footprint.width_m + 2.0 * rules.across_m};
  const Footprint stopping{footprint.length_m, footprint.width_m + 2.0 * rules.stopping_room_m};
  Numbers cells;
  for (std::size_t i = 0; i < count; ++i) {
    const double s_m = length_m * static_cast<double>(i) / static_cast<double>(count);
    const Point point_m = route.driving_line.at(route.path, s_m);
    const Pose pose{point_m.x(), point_m.y(),
                    road::chord_heading_rad(route.path, s_m, scale_ * kHalfChord_m)};
    const double slip = vehicle.rear_axle_to_cg_m *
                        road::chord_curvature_per_m(route.path, s_m, scale_ * kCurvatureChord_m);
    Pose turned = pose;
    turned.heading_rad -= std::asin(std::clamp(slip, -kMostSlip, kMostSlip));
    cells.push_back(joined({.pose = pose,
                            .area_m = footprint_area(footprint, turned),
                            .stopping_area_m = footprint_area(stopping, turned)},
                           rules, near));
  }
  routes_.push_back(std::move(cells));
  lengths_m_.push_back(length_m);
}

/// Number of the nearest cell that this one can be joined with, or of the new one.
std::uint32_t ConflictMap::joined(Cell cell, const ConflictRules& rules, NearPoints& near) {
  const Point place_m = cell.pose.position_m();
  const Point along{std::cos(cell.pose.heading_rad), std::sin(cell.pose.heading_rad)};
  auto best = static_cast<std::uint32_t>(cells_.size());
  double least_m = rules.joined_m;
  const auto consider = [&](std::uint32_t i) {
    const Pose& other = cells_[i].pose;
    const Point offset_m = other.position_m() - place_m;
    const double along_m = std::abs(along.dot(offset_m));
    const double across_m = std::abs(along.x() * offset_m.y() - along.y() * offset_m.x());
    const double turned_rad = std::abs(wrap_angle(other.heading_rad - cell.pose.heading_rad));
    if (across_m > scale_ * kSameLane_m || turned_rad > kSameLane_rad || along_m > least_m) return;
    best = i;
    least_m = along_m;
  };
  if (rules.joined_m > 0.0) near.visit(place_m, consider);
  if (best == cells_.size()) {
    near.add(place_m);
    cells_.push_back(std::move(cell));
  }
  return best;
}

void ConflictMap::add_lanes(std::size_t route, const ConflictRules& rules) {
  const Numbers& cells = routes_[route];
  const std::size_t count = cells.size();
  const std::size_t following =
      std::min(static_cast<std::size_t>(rules.following_m / cell_m(route)), (count - 1) / 2);
  for (std::size_t i = 0; i < count; ++i) {
    Numbers lane;
    for (std::size_t j = 0; j <= 2 * following; ++j) {
      lane.push_back(cells[(i + count - following + j) % count]);
    }
    std::ranges::sort(lane);
    const auto repeated = std::ranges::unique(lane);
    lane.erase(repeated.begin(), repeated.end());
    std::vector<Numbers>& known = cells_[cells[i]].lanes;
    if (std::ranges::find(known, lane) == known.end()) known.push_back(std::move(lane));
  }
}

void ConflictMap::relate(Cell& cell, const Numbers& near, const ConflictRules& rules) const {
  for (const std::uint32_t number : near) {
    const Cell& other = cells_[number];
    const double apart_m = (cell.pose.position_m() - other.pose.position_m()).norm();
    const double turned_rad = wrap_angle(cell.pose.heading_rad - other.pose.heading_rad);
    if (apart_m < rules.same_place_m && std::abs(turned_rad) < rules.same_heading_rad) {
      cell.same_place.push_back(number);
    }
    if (intersects(cell.area_m, other.area_m)) cell.overlaps.push_back(number);
  }
  const auto leads_here = [&](const Numbers& lane) {
    return std::ranges::any_of(
        cell.same_place, [&](std::uint32_t one) { return std::ranges::binary_search(lane, one); });
  };
  cell.is_conflict = std::ranges::any_of(near, [&](std::uint32_t other) {
    return intersects(cell.stopping_area_m, cells_[other].area_m) &&
           !std::ranges::all_of(cells_[other].lanes, leads_here);
  });
}

void ConflictMap::share_conflicts() {
  std::vector<bool> is_shared;
  for (const Cell& cell : cells_) {
    is_shared.push_back(std::ranges::any_of(
        cell.same_place, [&](std::uint32_t one) { return cells_[one].is_conflict; }));
  }
  for (std::size_t i = 0; i < cells_.size(); ++i) cells_[i].is_conflict = is_shared[i];
}

}  // namespace hlc::right_of_way
