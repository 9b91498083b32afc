#include "planner/road/route.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <string>
#include <utility>

namespace hlc::road {
namespace {

/// Points closer than this coincide [m]; far smaller than any gap for a footprint.
constexpr double kSamePoint_m = 1e-6;

const Lanelet& find_lanelet(const LaneletMap& map, LaneletId id) {
  const auto found = map.lanelets.find(id);
  if (found == map.lanelets.end()) {
    throw std::runtime_error(fmt::format("route: lanelet {} is not in the map", id));
  }
  return found->second;
}

void check_joint(const Lanelet& from, const Lanelet& to, const Point& end_m, const Point& begin_m) {
  const double gap_m = (end_m - begin_m).norm();
  if (gap_m > kMaxJointGap_m) {
    throw std::runtime_error(
        fmt::format("route: gap from the end of lanelet {} to the begin of lanelet {} = {:.1f} mm, "
                    "must be <= {:.1f} mm",
                    from.id, to.id, 1000.0 * gap_m, 1000.0 * kMaxJointGap_m));
  }
}

/// Centre line of a lanelet without consecutive duplicate points.
std::vector<Point> clean_centre_line(const Lanelet& lanelet) {
  std::vector<Point> points;
  for (const Point& point : centre_line_m(lanelet)) {
    if (points.empty() || (point - points.back()).norm() > kSamePoint_m) {
      points.push_back(point);
    }
  }
  if (points.size() < 2) {
    throw std::runtime_error(
        fmt::format("route: lanelet {} has no length, must be longer than 0", lanelet.id));
  }
  return points;
}

bool same_place(const Point& a, const Point& b) { return (a - b).norm() <= kMaxJointGap_m; }

/// Neighbour of the same direction according to the map, or nullptr.
const Lanelet* neighbour(const LaneletMap& map, const Lanelet& lanelet, Side side) {
  const auto& adjacent = side == Side::kLeft ? lanelet.adjacent_left : lanelet.adjacent_right;
  return adjacent && adjacent->same_direction ? &find_lanelet(map, adjacent->id) : nullptr;
}

/// The lane that begins beside `lanelet` and ends with it, or begins with it and ends beside it; or
/// nullptr.
const Lanelet* merging_or_forking(const LaneletMap& map, const Lanelet& lanelet, Side side) {
  for (const auto& [id, other] : map.lanelets) {
    const auto& inner = side == Side::kLeft ? lanelet.left_m : lanelet.right_m;
    const auto& touching = side == Side::kLeft ? other.right_m : other.left_m;
    const bool ends_together = same_place(other.left_m.back(), lanelet.left_m.back()) &&
                               same_place(other.right_m.back(), lanelet.right_m.back());
    const bool begins_together = same_place(other.left_m.front(), lanelet.left_m.front()) &&
                                 same_place(other.right_m.front(), lanelet.right_m.front());
    if ((ends_together && same_place(touching.front(), inner.front())) ||
        (begins_together && same_place(touching.back(), inner.back()))) {
      return &other;
    }
  }
  return nullptr;
}

/// Bound of the outermost lane on that side.
const std::vector<Point>& outer_bound(const LaneletMap& map, const Lanelet& lanelet, Side side) {
  const Lanelet* outermost = &lanelet;
  if (neighbour(map, lanelet, Side::kLeft) == nullptr &&
      neighbour(map, lanelet, Side::kRight) == nullptr) {
    if (const Lanelet* beside = merging_or_forking(map, lanelet, side)) {
      outermost = beside;
    }
  }
  // Maps in which lanes are neighbours in a circle must not cause an endless loop.
  for (std::size_t i = 0; i < map.lanelets.size(); ++i) {
    const Lanelet* next = neighbour(map, *outermost, side);
    if (next == nullptr) {
      break;
    }
    outermost = next;
  }
  return side == Side::kLeft ? outermost->left_m : outermost->right_m;
}

/// The boundary on one side of the route: the bounds of all lanelets, joined into one line.
Corridor::Bound bound_of(const LaneletMap& map, const Route& route, Side side) {
  Corridor::Bound bound{.side = side, .points_m = {}, .s_m = {}};
  for (std::size_t i = 0; i < route.lanelets.size(); ++i) {
    double s = route.lanelet_s_m[i];
    for (const Point& point : outer_bound(map, find_lanelet(map, route.lanelets[i]), side)) {
      const double from = s;
      s = route.path.project_within(point, from, route.lanelet_s_m[i + 1]).s_m;
      if (s < from - kSamePoint_m) {
        s += route.path.length_m();  // the end of a circuit projects to 0
      }
      bound.points_m.push_back(point);
      bound.s_m.push_back(s);
    }
  }
  if (route.path.is_closed()) {
    bound.points_m.push_back(bound.points_m.front());
    bound.s_m.push_back(bound.s_m.front() + route.path.length_m());
  }
  return bound;
}

}  // namespace

Route build_route(const LaneletMap& map, const std::vector<LaneletId>& lanelets, bool closed) {
  if (lanelets.empty()) {
    throw std::runtime_error("route: no lanelet, must be at least 1");
  }
  std::vector<Point> points;
  std::vector<std::size_t> begins;  // index of each lanelet's first point
  for (std::size_t i = 0; i < lanelets.size(); ++i) {
    const Lanelet& lanelet = find_lanelet(map, lanelets[i]);
    const std::vector<Point> centre = clean_centre_line(lanelet);
    if (i > 0) {
      check_joint(find_lanelet(map, lanelets[i - 1]), lanelet, points.back(), centre.front());
      points.back() = (points.back() + centre.front()) / 2.0;
    } else {
      points.push_back(centre.front());
    }
    begins.push_back(points.size() - 1);
    points.insert(points.end(), centre.begin() + 1, centre.end());
  }
  if (closed) {
    check_joint(find_lanelet(map, lanelets.back()), find_lanelet(map, lanelets.front()),
                points.back(), points.front());
    points.front() = (points.front() + points.back()) / 2.0;
    points.pop_back();
  }

  Route route{.lanelets = lanelets,
              .path = ReferencePath(std::move(points), closed),
              .corridor = {},
              .lanelet_s_m = {}};
  for (const std::size_t begin : begins) {
    route.lanelet_s_m.push_back(route.path.joints_s_m()[begin]);
  }
  route.lanelet_s_m.push_back(route.path.length_m());

  route.corridor = Corridor({bound_of(map, route, Side::kLeft), bound_of(map, route, Side::kRight)},
                            closed ? route.path.length_m() : 0.0, ground_m(map));
  return route;
}

}  // namespace hlc::road
