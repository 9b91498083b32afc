#include "planner/road/way_to_goal.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <optional>
#include <queue>
#include <stdexcept>
#include <string>
#include <utility>

#include "planner/road/lanelet_pieces.hpp"
#include "planner/road/placement.hpp"
#include "planner/road/route.hpp"

namespace hlc::road {
namespace {

/// A start on a bend may be off the place that its route gives it by this much.
constexpr double kOffStart_m = 0.05;

[[noreturn]] void fail(const std::string& what) { throw std::runtime_error(what); }

ReferencePath path_of(const LaneletMap& map, LaneletId id) {
  return build_route(map, {id}, false).path;
}

/// Where a vehicle starts on a path.
struct Start {
  double s_m{};
  double left_m{};
  double turned_rad{};
};

Start start_on(const ReferencePath& path, const Pose& pose) {
  const double s_m = path.project(pose.position_m()).s_m;
  const double heading_rad = path.heading_rad_at(s_m);
  const Point left(-std::sin(heading_rad), std::cos(heading_rad));
  return {.s_m = s_m,
          .left_m = left.dot(pose.position_m() - path.at(s_m)),
          .turned_rad = wrap_angle(pose.heading_rad - heading_rad)};
}

/// The lanelet of the start.
LaneletId start_lanelet(const LaneletMap& map, const std::set<LaneletId>& for_cars,
                        const Pose& start) {
  std::optional<LaneletId> best;
  double best_rad = std::numeric_limits<double>::infinity();
  for (const auto& [id, lanelet] : map.lanelets) {
    if (!for_cars.contains(id) || !contains(lanelet, start.position_m())) continue;
    const double turned_rad = std::abs(start_on(path_of(map, id), start).turned_rad);
    if (turned_rad < best_rad) {
      best = id;
      best_rad = turned_rad;
    }
  }
  if (!best) fail("position of the initial state, must be in a lanelet for cars");
  if (best_rad > kFitsTurned_rad) {
    fail(
        fmt::format("orientation of the initial state is {:.3f} rad off the direction of lanelet "
                    "{}, must be <= {} rad",
                    best_rad, *best, kFitsTurned_rad));
  }
  return *best;
}

/// The lanelet and its neighbours of the same direction, nearest first.
std::vector<LaneletId> lanes_beside(const LaneletMap& map, LaneletId id) {
  std::vector<LaneletId> lanes{id};
  for (std::size_t i = 0; i < lanes.size(); ++i) {
    const Lanelet& lanelet = map.lanelets.at(lanes[i]);
    for (const auto& adjacent : {lanelet.adjacent_left, lanelet.adjacent_right}) {
      if (!adjacent || !adjacent->same_direction) continue;
      if (std::ranges::find(lanes, adjacent->id) == lanes.end()) lanes.push_back(adjacent->id);
    }
  }
  return lanes;
}

/// Shortest ways from a lanelet to the others, in the order of their lengths.
class Ways {
 public:
  Ways(const LaneletMap& map, const std::set<LaneletId>& for_cars, LaneletId from)
      : map_(map), for_cars_(for_cars) {
    reached_.push_back({.id = from, .before = kNone});
    queue_.emplace(0.0, 0);
  }

  /// The next one, lanelets in order; none: no further one. The first lanelet may be entered again,
  /// so that a way may lead round to it.
  [[nodiscard]] std::optional<std::vector<LaneletId>> next() {
    while (!queue_.empty()) {
      const auto [before_m, index] = queue_.top();
      queue_.pop();
      const LaneletId id = reached_[index].id;
      if (index > 0 && !passed_.insert(id).second) continue;
      const double until_m = before_m + path_of(map_, id).length_m();
      for (const LaneletId successor : map_.lanelets.at(id).successors) {
        if (!for_cars_.contains(successor) || passed_.contains(successor)) continue;
        reached_.push_back({.id = successor, .before = index});
        queue_.emplace(until_m, reached_.size() - 1);
      }
      return way_to(index);
    }
    return std::nullopt;
  }

 private:
  static constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
  struct Reached {
    LaneletId id{};
    std::size_t before{};  ///< index in reached_
  };
  using Entry = std::pair<double, std::size_t>;  // length before it [m], index in reached_

  [[nodiscard]] std::vector<LaneletId> way_to(std::size_t index) const {
    std::vector<LaneletId> lanelets;
    for (std::size_t i = index; i != kNone; i = reached_[i].before) {
      lanelets.push_back(reached_[i].id);
    }
    std::ranges::reverse(lanelets);
    return lanelets;
  }

  const LaneletMap& map_;
  const std::set<LaneletId>& for_cars_;
  std::vector<Reached> reached_;
  std::set<LaneletId> passed_;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue_;
};

/// Finds ways for one planning problem.
class WaySearch {
 public:
  WaySearch(const LaneletMap& map, const std::set<LaneletId>& for_cars, const Pose& start,
            const Footprint& footprint)
      : map_(map),
        for_cars_(for_cars),
        start_(start),
        footprint_(footprint),
        lanes_(lanes_beside(map, start_lanelet(map, for_cars, start))) {
    const Box ground = ground_m(map);
    const Box car = bounding_box(footprint_area(footprint, start));
    if ((car.min_m.array() < ground.min_m.array()).any() ||
        (car.max_m.array() > ground.max_m.array()).any()) {
      fail(
          "position of the initial state, must be so far from the end of the map that the whole "
          "car is on it");
    }
  }

  [[nodiscard]] WayToGoal to(const GoalState& goal) const {
    if (goal.speed_mps && !(goal.speed_mps->from <= 0.0 && goal.speed_mps->to >= 0.0)) {
      fail(
          fmt::format("velocity of the goal state is in {} ... {} m/s, must include 0: a car "
                      "stands when it has arrived",
                      goal.speed_mps->from, goal.speed_mps->to));
    }
    const std::vector<ConvexPolygon> regions = regions_of(goal);
    double longest_m = 0.0;
    for (const LaneletId lane : lanes_) {
      if (!for_cars_.contains(lane)) continue;
      if (auto way = way_from(lane, regions, longest_m)) {
        check(*way, goal);
        return *way;
      }
    }
    if (longest_m > 0.0) {
      fail(
          fmt::format("position of the goal state: the way is in its region for {:.2f} m, must be "
                      ">= {} m, the car's length",
                      longest_m, footprint_.length_m));
    }
    fail(
        "position of the goal state, must be reached from the initial state, or a lane beside it, "
        "by successors for cars");
  }

 private:
  [[nodiscard]] std::vector<ConvexPolygon> regions_of(const GoalState& goal) const {
    std::vector<ConvexPolygon> regions = goal.areas_m;
    for (const LaneletId id : goal.lanelets) {
      const auto lanelet = map_.lanelets.find(id);
      if (lanelet == map_.lanelets.end()) {
        fail(fmt::format("position of the goal state has lanelet {}, must be one of the file", id));
      }
      regions.push_back(convex_part_of(lanelet->second, kMostGoalCorners));
      if (regions.back().empty()) {
        fail(
            fmt::format("position of the goal state has lanelet {}, must be one whose bounds lie "
                        "side by side",
                        id));
      }
    }
    for (const ConvexPolygon& region : regions) {
      if (region.vertices_m.size() > kMostGoalCorners) {
        fail(fmt::format("position of the goal state has a polygon of {} corners, must be <= {}",
                         region.vertices_m.size(), kMostGoalCorners));
      }
      if (contains(region, start_.position_m())) {
        fail("position of the initial state is in the region of a goal state, must be before it");
      }
    }
    return regions;
  }

  /// @param longest_m  of the stretches in a region that are too short, and its value before
  [[nodiscard]] std::optional<WayToGoal> way_from(LaneletId lane,
                                                  const std::vector<ConvexPolygon>& regions,
                                                  double& longest_m) const {
    Ways ways(map_, for_cars_, lane);
    const Start start = start_on(path_of(map_, lane), start_);
    while (const auto lanelets = ways.next()) {
      const ReferencePath path = build_route(map_, *lanelets, false).path;
      for (const ConvexPolygon& region : regions) {
        if (!first_stretch_in(path, region, start.s_m)) continue;
        WayToGoal way{.lanelets = *lanelets,
                      .start_s_m = start.s_m,
                      .start_left_m = start.left_m,
                      .start_turned_rad = start.turned_rad,
                      .goal_m = region,
                      .stretch_in_goal = {}};
        lead_through(way);
        const double in_goal_m = way.stretch_in_goal.to_s_m - way.stretch_in_goal.from_s_m;
        if (in_goal_m >= footprint_.length_m) return way;
        longest_m = std::max(longest_m, in_goal_m);
      }
    }
    return std::nullopt;
  }

  /// Further successors, until the path leaves the region.
  void lead_through(WayToGoal& way) const {
    for (std::size_t i = 0; i < map_.lanelets.size(); ++i) {
      const ReferencePath path = build_route(map_, way.lanelets, false).path;
      way.stretch_in_goal = *first_stretch_in(path, way.goal_m, way.start_s_m);
      if (way.stretch_in_goal.to_s_m < path.length_m()) return;
      const auto& successors = map_.lanelets.at(way.lanelets.back()).successors;
      const auto next =
          std::ranges::find_if(successors, [&](LaneletId id) { return for_cars_.contains(id); });
      if (next == successors.end()) return;
      way.lanelets.push_back(*next);
    }
  }

  void check(const WayToGoal& way, const GoalState& goal) const {
    const Route route = build_route(map_, way.lanelets, false);
    check_start(way, route.path);
    for (const LaneletId id : way.lanelets) {
      for (const LaneletId beside : lanes_beside(map_, id)) {
        if (for_cars_.contains(beside)) continue;
        fail(
            fmt::format("the way to the goal is beside lanelet {} of the same direction, which "
                        "must be for cars",
                        beside));
      }
    }
    if (goal.heading_rad) check_headings(way, route.path, *goal.heading_rad);
  }

  void check_start(const WayToGoal& way, const ReferencePath& path) const {
    const double heading_rad = path.heading_rad_at(way.start_s_m);
    const Point placed_m = path.at(way.start_s_m) +
                           way.start_left_m * Point(-std::sin(heading_rad), std::cos(heading_rad));
    const double off_m = (placed_m - start_.position_m()).norm();
    if (off_m <= kOffStart_m) return;
    fail(
        fmt::format("position of the initial state is {:.2f} m off the nearest place of its way, "
                    "must be <= {} m",
                    off_m, kOffStart_m));
  }

  static void check_headings(const WayToGoal& way, const ReferencePath& path,
                             const Interval& allowed) {
    const double middle_rad = std::midpoint(allowed.from, allowed.to);
    const double half_rad = (allowed.to - allowed.from) / 2.0;
    if (half_rad >= std::numbers::pi) return;
    const auto check_at = [&](double s_m) {
      const double off_rad = std::abs(wrap_angle(path.heading_rad_at(s_m) - middle_rad));
      if (off_rad + kFitsTurned_rad <= half_rad) return;
      fail(
          fmt::format("orientation of the goal state is in {} ... {} rad, must include the way's, "
                      "{:.3f} rad, and {} rad to either side",
                      allowed.from, allowed.to, path.heading_rad_at(s_m), kFitsTurned_rad));
    };
    check_at(way.stretch_in_goal.from_s_m);
    for (const double s_m : path.joints_s_m()) {
      if (s_m > way.stretch_in_goal.from_s_m && s_m < way.stretch_in_goal.to_s_m) check_at(s_m);
    }
  }

  const LaneletMap& map_;
  const std::set<LaneletId>& for_cars_;
  Pose start_;
  Footprint footprint_;
  std::vector<LaneletId> lanes_;
};

}  // namespace

WayToGoal way_to_goal(const LaneletMap& map, const std::set<LaneletId>& for_cars,
                      const PlanningProblem& problem, const Footprint& footprint) {
  const auto named = [&problem](const std::exception& error) {
    return std::runtime_error(fmt::format("planning problem {}: {}", problem.id, error.what()));
  };
  std::optional<std::runtime_error> first_fault;
  for (std::size_t i = 0; i < problem.goals.size(); ++i) {
    try {
      WayToGoal way = WaySearch(map, for_cars, problem.start, footprint).to(problem.goals[i]);
      way.goal_state = i;
      return way;
    } catch (const std::exception& error) {
      if (!first_fault) first_fault = named(error);
    }
  }
  throw *first_fault;
}

}  // namespace hlc::road
