#include "planner/road/placement.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

namespace hlc::road {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// A pose is compared with the path this far around its place.
constexpr double kAround_m = 0.4;
/// Distance of two points at which a footprint's outline is compared with the bounds.
constexpr double kOutline_m = 0.01;
constexpr double kFront_m = 0.1;

Point along(double heading_rad) { return {std::cos(heading_rad), std::sin(heading_rad)}; }

/// Across the direction of travel, outwards on that side.
Point outwards(const Point& direction, Side side) {
  const Point left(-direction.y(), direction.x());
  return side == Side::kLeft ? left : Point(-left);
}

/// True if s + k * length lies in [from, to] for an integer k (k = 0 on an open route).
bool is_in_window(double s_m, double from_s_m, double to_s_m, double length_m) {
  if (length_m <= 0.0) return s_m >= from_s_m && s_m <= to_s_m;
  const double turns = std::ceil((from_s_m - s_m) / length_m);
  return s_m + turns * length_m <= to_s_m;
}

/// A piece of a bound with s in [middle - reach, middle + reach].
struct BoundPiece {
  Point from_m;
  Point to_m;
  double middle_s_m;
  double reach_m;
};

/// The side's pieces with some s in [from, to].
std::vector<BoundPiece> pieces_between(const Corridor& corridor, Side side, double from_s_m,
                                       double to_s_m) {
  std::vector<BoundPiece> pieces;
  for (const Corridor::Bound& bound : corridor.bounds()) {
    if (bound.side != side) continue;
    for (std::size_t i = 0; i + 1 < bound.points_m.size(); ++i) {
      const BoundPiece piece{bound.points_m[i], bound.points_m[i + 1],
                             (bound.s_m[i] + bound.s_m[i + 1]) / 2.0,
                             (bound.s_m[i + 1] - bound.s_m[i]) / 2.0 + kAround_m / 4.0};
      if (is_in_window(piece.middle_s_m, from_s_m - piece.reach_m, to_s_m + piece.reach_m,
                       corridor.route_length_m())) {
        pieces.push_back(piece);
      }
    }
  }
  return pieces;
}

/// Distance of the bound from the path at s, along the normal there; infinite if there is none.
double bound_m(std::span<const BoundPiece> pieces, Side side, double route_length_m, double s_m,
               const Point& origin_m, const Point& direction) {
  const Point normal = outwards(direction, side);
  double nearest_m = kInfinity;
  for (const BoundPiece& piece : pieces) {
    const Point from = piece.from_m - origin_m;
    const Point to = piece.to_m - origin_m;
    const double a = direction.dot(from);
    const double b = direction.dot(to);
    if (a * b > 0.0 || a == b) continue;
    if (!is_in_window(piece.middle_s_m, s_m - piece.reach_m, s_m + piece.reach_m, route_length_m)) {
      continue;
    }
    const double t = a / (a - b);
    const double across_m = normal.dot((1.0 - t) * from + t * to);
    if (across_m > 0.0) nearest_m = std::min(nearest_m, across_m);
  }
  return nearest_m;
}

std::vector<Point> outline(const ConvexPolygon& area) {
  std::vector<Point> points;
  const auto& corners = area.vertices_m;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Point edge = corners[(i + 1) % corners.size()] - corners[i];
    const auto parts = static_cast<int>(std::ceil(edge.norm() / kOutline_m));
    for (int k = 0; k < parts; ++k) points.emplace_back(corners[i] + edge * k / parts);
  }
  return points;
}

/// Fills in how far the outline reaches beyond the bounds.
void look_beyond(const DrivableRoute& route, const std::vector<Point>& outline_m,
                 Placement& placement) {
  const Corridor& corridor = route.corridor;
  const double from_s_m = placement.s_m - kAround_m;
  const double to_s_m = placement.s_m + kAround_m;
  struct OneSide {
    Side side;
    double& beyond_m;
    std::vector<BoundPiece> pieces;
  };
  std::array<OneSide, 2> sides{OneSide{Side::kLeft, placement.beyond_left_m,
                                       pieces_between(corridor, Side::kLeft, from_s_m, to_s_m)},
                               OneSide{Side::kRight, placement.beyond_right_m,
                                       pieces_between(corridor, Side::kRight, from_s_m, to_s_m)}};
  for (OneSide& one : sides) one.beyond_m = -kInfinity;
  for (const Point& point : outline_m) {
    const double at_s_m = route.path.project_within(point, from_s_m, to_s_m).s_m;
    const Point origin_m = route.path.at(at_s_m);
    const Point direction = along(route.path.heading_rad_at(at_s_m));
    for (OneSide& one : sides) {
      const double across_m = outwards(direction, one.side).dot(point - origin_m);
      const double room_m =
          bound_m(one.pieces, one.side, corridor.route_length_m(), at_s_m, origin_m, direction);
      one.beyond_m = std::max(one.beyond_m, across_m - room_m);
    }
  }
}

/// Whether the place counts instead of the best one so far: if it is better, and not only a little
/// where the path drives the same lane again.
bool replaces(const Placement& place, const Placement& best, const ReferencePath& path) {
  const double gain_m = placement_cost_m(best) - placement_cost_m(place);
  if (gain_m <= 0.0) return false;
  return gain_m > kSameLane_m || !drives_again(path, best.s_m, place.s_m);
}

/// The best of the nearest points of all segments of the path, in their order from `from_s_m` on.
/// @param scale  of the vehicle
Placement best_place(const ReferencePath& path, const Pose& pose, std::optional<double> from_s_m,
                     double scale) {
  Placement near_by{.distance_m = kInfinity};
  Placement elsewhere{.distance_m = kInfinity};
  const std::vector<double>& joints = path.joints_s_m();
  const std::size_t num_segments = joints.size() - 1;
  double s_m = from_s_m.value_or(0.0);
  if (path.is_closed()) s_m -= std::floor(s_m / path.length_m()) * path.length_m();
  const auto first = static_cast<std::size_t>(
      std::upper_bound(joints.begin() + 1, joints.end() - 1, s_m) - joints.begin() - 1);
  for (std::size_t k = 0; k < num_segments; ++k) {
    const std::size_t i = (first + k) % num_segments;
    const bool is_behind = !path.is_closed() && i < first;
    const double way_m = joints[i] - s_m + (i < first ? path.length_m() : 0.0);
    Placement& best = from_s_m && (is_behind || way_m > scale * kNearBy_m) ? elsewhere : near_by;
    // Most segments are too far away, in any direction: none of their points is nearer than the
    // first by more than the length.
    const double from_first_m = (pose.position_m() - path.points_m()[i]).norm();
    if (from_first_m - (joints[i + 1] - joints[i]) > placement_cost_m(best)) continue;
    const auto projection = path.project_within(pose.position_m(), joints[i], joints[i + 1]);
    const double heading_rad = path.heading_rad_at((joints[i] + joints[i + 1]) / 2.0);
    const Placement one{.s_m = projection.s_m,
                        .distance_m = projection.distance_m,
                        .turned_rad = wrap_angle(pose.heading_rad - heading_rad)};
    if (replaces(one, best, path)) best = one;
  }
  const double gain_m = placement_cost_m(near_by) - placement_cost_m(elsewhere);
  return gain_m > scale * kElsewhere_m ? elsewhere : near_by;
}

}  // namespace

double Placement::beyond_m() const { return std::max(beyond_left_m, beyond_right_m); }

double placement_cost_m(const Placement& placement) {
  return placement.distance_m + kFront_m * std::abs(placement.turned_rad);
}

bool fits(const Placement& placement, const DrivableRoute& route) {
  if (route.corridor.bounds().empty()) return true;
  return placement.is_on_ground && placement.beyond_m() <= kFitsBeyond_m &&
         std::abs(placement.turned_rad) <= kFitsTurned_rad;
}

Placement placement_on(const DrivableRoute& route, const Pose& pose, const Footprint& footprint,
                       std::optional<double> from_s_m) {
  Placement placement = best_place(route.path, pose, from_s_m, scale_of(footprint));
  const ConvexPolygon area = footprint_area(footprint, pose);
  look_beyond(route, outline(area), placement);
  if (!route.corridor.bounds().empty()) {
    const Box box = bounding_box(area);
    const Box& ground = route.corridor.ground_m();
    placement.is_on_ground = (box.min_m.array() >= ground.min_m.array()).all() &&
                             (box.max_m.array() <= ground.max_m.array()).all();
  }
  return placement;
}

Corridor widened(const DrivableRoute& route, const Widening& widening) {
  const Corridor& corridor = route.corridor;
  const Box& ground = corridor.ground_m();
  std::vector<Corridor::Bound> bounds = corridor.bounds();
  for (Corridor::Bound& bound : bounds) {
    const double by_m = bound.side == Side::kLeft ? widening.left_m : widening.right_m;
    for (std::size_t i = 0; i < bound.points_m.size(); ++i) {
      if (!is_in_window(bound.s_m[i], widening.from_s_m, widening.to_s_m,
                        corridor.route_length_m())) {
        continue;
      }
      Point& point = bound.points_m[i];
      const Point moved =
          point + by_m * outwards(along(route.path.heading_rad_at(bound.s_m[i])), bound.side);
      point = moved.cwiseMax(ground.min_m.cwiseMin(point)).cwiseMin(ground.max_m.cwiseMax(point));
    }
  }
  return {std::move(bounds), corridor.route_length_m(), ground};
}

}  // namespace hlc::road
