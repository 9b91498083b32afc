#include "planner/automaton/reachable_sets.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "planner/common/demand.hpp"
#include "planner/geometry/footprint.hpp"

namespace hlc::automaton {
namespace {

/// Kept vertices of a swept area's hull; the recursion itself uses all of them.
constexpr std::size_t kMaxReachVertices = 16;

/// The extreme points in eight directions, counter-clockwise; points may repeat.
std::array<Point, 8> extreme_points(const std::vector<Point>& points_m) {
  const std::array<Point, 8> directions{Point{1, 0},  Point{1, 1},   Point{0, 1},  Point{-1, 1},
                                        Point{-1, 0}, Point{-1, -1}, Point{0, -1}, Point{1, -1}};
  std::array<Point, 8> extreme;
  std::array<double, 8> largest;
  largest.fill(-std::numeric_limits<double>::infinity());
  for (const Point& point : points_m) {
    for (std::size_t i = 0; i < directions.size(); ++i) {
      const double along = directions[i].dot(point);
      if (along <= largest[i]) continue;
      largest[i] = along;
      extreme[i] = point;
    }
  }
  return extreme;
}

/// Drops points that lie clearly inside the polygon of the extreme points: they are no vertices of
/// the hull, and sorting the remaining ones is much faster.
void drop_inner_points(std::vector<Point>& points_m) {
  constexpr std::size_t kFew = 64;
  if (points_m.size() < kFew) return;
  const std::array<Point, 8> extreme = extreme_points(points_m);
  std::array<Point, 8> along;
  std::array<double, 8> clear;
  for (std::size_t i = 0; i < extreme.size(); ++i) {
    along[i] = extreme[(i + 1) % extreme.size()] - extreme[i];
    clear[i] = 10.0 * kHullTolerance_m * along[i].norm();
  }
  std::erase_if(points_m, [&](const Point& point) {
    bool is_inner = false;
    for (std::size_t i = 0; i < extreme.size(); ++i) {
      if (along[i].isZero(0.0)) continue;
      const Point offset = point - extreme[i];
      if (along[i].x() * offset.y() - along[i].y() * offset.x() <= clear[i]) return false;
      is_inner = true;
    }
    return is_inner;
  });
}

Reach reach_of(const std::vector<Point>& points_m, double allowance_m) {
  constexpr double kNothing = -std::numeric_limits<double>::infinity();
  Reach reach{.max_distance_m = kNothing, .support_m = {}};
  reach.support_m.fill(kNothing);
  for (const Point& point : points_m) {
    reach.max_distance_m = std::max(reach.max_distance_m, point.norm() + allowance_m);
    for (std::size_t i = 0; i < kReachDirections.size(); ++i) {
      const double along_m =
          kReachDirections[i][0] * point.x() + kReachDirections[i][1] * point.y();
      reach.support_m[i] = std::max(reach.support_m[i], along_m + allowance_m);
    }
  }
  return reach;
}

/// Footprint with margin at the origin, for the planned heading and for the driven yaw.
std::vector<Point> standing_area_m(const UniversalAutomaton& automaton, TrimId trim) {
  const double yaw_rad = yaw_minus_heading_rad(automaton.trims[trim.index].steering_rad,
                                               automaton.vehicle, automaton.identified);
  const Footprint& footprint = automaton.vehicle.footprint;
  const double margin_m = automaton.vehicle.safety_margin_m;
  std::vector<Point> points_m;
  for (const double heading_rad : {0.0, yaw_rad}) {
    const ConvexPolygon area = footprint_area(footprint, {0.0, 0.0, heading_rad}, margin_m);
    points_m.insert(points_m.end(), area.vertices_m.begin(), area.vertices_m.end());
  }
  return hull_vertices(std::move(points_m));
}

/// Swept areas of the first step, over all successors.
std::vector<Point> first_step_area_m(const Subgraph& subgraph, TrimId trim) {
  std::vector<Point> points_m;
  for (const Edge& edge : subgraph.successors(trim)) {
    const auto& vertices = edge.maneuver->swept_area_m.vertices_m;
    points_m.insert(points_m.end(), vertices.begin(), vertices.end());
  }
  return hull_vertices(std::move(points_m));
}

ConvexPolygon containing(std::vector<Point> points_m, std::size_t steps) {
  const ConvexPolygon hull = convex_hull(std::move(points_m));
  return simplified_outwards(inflated(hull, ReachableSets::allowance_m(steps + 1)),
                             kMaxReachVertices);
}

}  // namespace

ReachableSets::ReachableSets(const Subgraph& subgraph, std::size_t max_steps)
    : max_steps_(max_steps), num_trims_(subgraph.automaton().trims.size()) {
  for (const TrimId trim : subgraph.start_trims()) {
    max_steps_left_ = std::max(max_steps_left_, subgraph.distance_to_standstill(trim));
  }
  shifts_.resize(num_trims_);
  for (const TrimId trim : subgraph.start_trims()) {
    for (const Edge& edge : subgraph.successors(trim)) {
      const Pose& end = edge.maneuver->displacement;
      shifts_[trim.index].push_back(
          {edge.to, end.position_m(), std::cos(end.heading_rad), std::sin(end.heading_rad)});
    }
  }
  const std::size_t rows = (max_steps_ + 1) * (max_steps_left_ + 1);
  reach_.assign(rows * num_trims_, reach_of({}, 0.0));
  positions_m_.resize(reach_.size());
  for (std::size_t steps_left = 0; steps_left <= max_steps_left_; ++steps_left) {
    compute_reach(subgraph, steps_left);
  }
  compute_swept_areas(subgraph);
  shifts_.clear();
}

/// Vertices of the hull of the successors' sets, each seen through its edge: hull of union over
/// successors u of T_tu * sets[u].
std::vector<Point> ReachableSets::hull_over_successors(TrimId trim,
                                                       const SetPerTrim& sets_m) const {
  std::vector<Point> points_m;
  for (const Shift& shift : shifts_[trim.index]) {
    for (const Point& point : sets_m[shift.to.index]) {
      points_m.emplace_back(
          shift.origin_m.x() + shift.cos_heading * point.x() - shift.sin_heading * point.y(),
          shift.origin_m.y() + shift.sin_heading * point.x() + shift.cos_heading * point.y());
    }
  }
  drop_inner_points(points_m);
  return hull_vertices(std::move(points_m));
}

void ReachableSets::compute_reach(const Subgraph& subgraph, std::size_t steps_left) {
  SetPerTrim sets_m(num_trims_);
  for (std::size_t steps = 0; steps <= max_steps_; ++steps) {
    SetPerTrim next_m(num_trims_);
    for (const TrimId trim : subgraph.start_trims()) {
      if (steps > 0) {
        next_m[trim.index] = hull_over_successors(trim, sets_m);
      } else if (subgraph.distance_to_standstill(trim) <= steps_left) {
        next_m[trim.index] = {Point::Zero()};
      }
      const std::size_t index = reach_index(trim, steps, steps_left);
      reach_[index] = reach_of(next_m[trim.index], allowance_m(steps));
      positions_m_[index] = next_m[trim.index];
    }
    sets_m = std::move(next_m);
  }
}

void ReachableSets::compute_swept_areas(const Subgraph& subgraph) {
  swept_area_m_.resize((max_steps_ + 1) * num_trims_);
  swept_area_until_m_.resize(swept_area_m_.size());
  SetPerTrim sets_m(num_trims_);
  SetPerTrim until_m(num_trims_);
  for (std::size_t step = 0; step <= max_steps_; ++step) {
    SetPerTrim next_m(num_trims_);
    for (const TrimId trim : subgraph.start_trims()) {
      std::vector<Point>& set_m = next_m[trim.index];
      if (step == 0) {
        set_m = standing_area_m(subgraph.automaton(), trim);
      } else if (step == 1) {
        set_m = first_step_area_m(subgraph, trim);
      } else {
        set_m = hull_over_successors(trim, sets_m);
      }
      std::vector<Point>& all_m = until_m[trim.index];
      all_m.insert(all_m.end(), set_m.begin(), set_m.end());
      all_m = hull_vertices(std::move(all_m));
      swept_area_m_[area_index(trim, step)] = containing(set_m, step);
      swept_area_until_m_[area_index(trim, step)] = containing(all_m, step);
    }
    sets_m = std::move(next_m);
  }
}

const Reach& ReachableSets::reach(TrimId trim, std::size_t steps, std::size_t steps_left) const {
  HLC_DEMAND(trim.index < num_trims_ && steps <= max_steps_, trim.index, num_trims_, steps,
             max_steps_);
  return reach_[reach_index(trim, steps, std::min(steps_left, max_steps_left_))];
}

std::span<const Point> ReachableSets::positions_m(TrimId trim, std::size_t steps,
                                                  std::size_t steps_left) const {
  HLC_DEMAND(trim.index < num_trims_ && steps <= max_steps_, trim.index, num_trims_, steps,
             max_steps_);
  return positions_m_[reach_index(trim, steps, std::min(steps_left, max_steps_left_))];
}

const ConvexPolygon& ReachableSets::swept_area_m(TrimId trim, std::size_t step) const {
  HLC_DEMAND(trim.index < num_trims_ && step <= max_steps_, trim.index, num_trims_, step,
             max_steps_);
  return swept_area_m_[area_index(trim, step)];
}

const ConvexPolygon& ReachableSets::swept_area_until_m(TrimId trim, std::size_t steps) const {
  HLC_DEMAND(trim.index < num_trims_ && steps <= max_steps_, trim.index, num_trims_, steps,
             max_steps_);
  return swept_area_until_m_[area_index(trim, steps)];
}

std::size_t ReachableSets::reach_index(TrimId trim, std::size_t steps,
                                       std::size_t steps_left) const {
  return (steps_left * (max_steps_ + 1) + steps) * num_trims_ + trim.index;
}

std::size_t ReachableSets::area_index(TrimId trim, std::size_t step) const {
  return step * num_trims_ + trim.index;
}

}  // namespace hlc::automaton
