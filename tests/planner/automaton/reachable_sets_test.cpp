#include "planner/automaton/reachable_sets.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <random>

#include "tests/planner/automaton/paper_automaton.hpp"

namespace hlc::automaton {
namespace {

constexpr std::size_t kSteps = 5;
constexpr std::size_t kLongSteps = 9;

const Subgraph& subgraph_b() {
  static const Subgraph subgraph(paper_automaton(), paper_configuration().subgraphs.front());
  return subgraph;
}

const ReachableSets& sets_b() {
  static const ReachableSets sets(subgraph_b(), kLongSteps);
  return sets;
}

/// Calls `visit(trim, pose, steps)` for every path of at most `max_steps` steps.
void for_every_path(const Subgraph& subgraph, TrimId trim, const Pose& pose, std::size_t steps,
                    std::size_t max_steps,
                    const std::function<void(TrimId, const Pose&, std::size_t)>& visit) {
  visit(trim, pose, steps);
  if (steps == max_steps) {
    return;
  }
  for (const Edge& edge : subgraph.successors(trim)) {
    for_every_path(subgraph, edge.to, compose(pose, edge.maneuver->displacement), steps + 1,
                   max_steps, visit);
  }
}

TEST(ReachableSets, MaxDistanceIsTheLargestOfAllPermittedPaths) {
  for (const TrimId start : subgraph_b().spec().trims) {
    for (std::size_t steps_left = 0; steps_left <= 1; ++steps_left) {
      std::vector<double> largest(kSteps + 1, -std::numeric_limits<double>::infinity());
      for_every_path(subgraph_b(), start, Pose{}, 0, kSteps,
                     [&](TrimId trim, const Pose& pose, std::size_t steps) {
                       if (subgraph_b().distance_to_standstill(trim) <= steps_left) {
                         largest[steps] = std::max(largest[steps], pose.position_m().norm());
                       }
                     });
      for (std::size_t steps = 0; steps <= kSteps; ++steps) {
        const double bound = sets_b().max_distance_m(start, steps, steps_left);
        if (std::isinf(largest[steps])) {
          EXPECT_EQ(bound, largest[steps]);
          continue;
        }
        EXPECT_GE(bound, largest[steps]);
        EXPECT_LE(bound, largest[steps] + 1e-9);
      }
    }
  }
}

TEST(ReachableSets, LongRandomPathsNeverExceedTheMaxDistanceAndSomeNearlyReachIt) {
  constexpr unsigned kSeed = 41;
  SCOPED_TRACE(kSeed);
  std::mt19937 random(kSeed);
  std::map<std::pair<std::size_t, std::size_t>, double> largest_share;  // by steps, steps left
  for (int run = 0; run < 20000; ++run) {
    const TrimId start = pi(1 + random() % 12U);
    const std::size_t steps = 1 + random() % kLongSteps;
    // Half of the paths head for high speed, so that the bound is tried where it is tight.
    const bool hurry = run % 2 == 0;
    TrimId trim = start;
    Pose pose;
    for (std::size_t step = 0; step < steps; ++step) {
      const auto edges = subgraph_b().successors(trim);
      const Edge* edge = &edges[random() % edges.size()];
      if (hurry) {
        for (const Edge& other : edges) {
          const bool last = step + 1 == steps && run % 4 == 0;
          const double speed = paper_automaton()->trims[other.to.index].speed_mps;
          if (last ? speed == 0.0
                   : speed > paper_automaton()->trims[edge->to.index].speed_mps + 0.05) {
            edge = &other;
          }
        }
      }
      pose = compose(pose, edge->maneuver->displacement);
      trim = edge->to;
    }
    const std::size_t distance = subgraph_b().distance_to_standstill(trim);
    for (std::size_t steps_left = distance; steps_left <= 2; ++steps_left) {
      const double bound = sets_b().max_distance_m(start, steps, steps_left);
      ASSERT_LE(pose.position_m().norm(), bound);
      double& share = largest_share[{steps, steps_left}];
      share = std::max(share, bound > 1e-6 ? pose.position_m().norm() / bound : 1.0);
    }
  }
  for (const auto& [key, share] : largest_share) {
    EXPECT_GE(share, 0.99) << key.first << " steps, " << key.second << " left";
  }
}

TEST(ReachableSets, StepsLeftBeyondTheLargestDistanceToStandstillMakeNoDifference) {
  EXPECT_EQ(sets_b().max_distance_m(pi(7), 4, 1), sets_b().max_distance_m(pi(7), 4, 100));
  EXPECT_LT(sets_b().max_distance_m(pi(7), 4, 0), sets_b().max_distance_m(pi(7), 4, 1));
}

TEST(ReachableSets, NoPermittedPathIsMinusInfinity) {
  EXPECT_EQ(sets_b().max_distance_m(pi(7), 0, 0), -std::numeric_limits<double>::infinity());
  EXPECT_EQ(sets_b().max_distance_m(pi(7), 0, 1), 0.0);
  EXPECT_EQ(sets_b().max_distance_m(pi(1), 0, 0), 0.0);
}

TEST(ReachableSets, SweptAreasHoldThoseOfAllPathsAndAreTight) {
  for (const TrimId start : {pi(1), pi(2), pi(7), pi(9)}) {
    std::vector<std::vector<Point>> corners_m(kSteps + 1);
    for_every_path(subgraph_b(), start, Pose{}, 0, kSteps - 1,
                   [&](TrimId trim, const Pose& pose, std::size_t steps) {
                     for (const Edge& edge : subgraph_b().successors(trim)) {
                       const auto area = transformed(edge.maneuver->swept_area_m, pose);
                       corners_m[steps + 1].insert(corners_m[steps + 1].end(),
                                                   area.vertices_m.begin(), area.vertices_m.end());
                     }
                   });
    const auto& first_m = sets_b().swept_area_m(start, 0).vertices_m;
    std::vector<Point> until_m(first_m.begin(), first_m.end());
    for (std::size_t step = 1; step <= kSteps; ++step) {
      const ConvexPolygon& area = sets_b().swept_area_m(start, step);
      const ConvexPolygon& until = sets_b().swept_area_until_m(start, step);
      until_m.insert(until_m.end(), corners_m[step].begin(), corners_m[step].end());
      for (const Point& corner : corners_m[step]) {
        ASSERT_TRUE(contains(area, corner));
      }
      for (const Point& corner : until_m) {
        ASSERT_TRUE(contains(until, corner));
      }
      // Every edge touches what it has to hold: nothing is added but the corners cut off by
      // simplifying.
      for (const auto& [polygon, points] :
           {std::pair{&area, &corners_m[step]}, std::pair{&until, &until_m}}) {
        const auto& v = polygon->vertices_m;
        EXPECT_LE(v.size(), 16U);
        for (std::size_t i = 0; i < v.size(); ++i) {
          const Point edge = v[(i + 1) % v.size()] - v[i];
          const Point inwards = Point(-edge.y(), edge.x()).normalized();
          double nearest = std::numeric_limits<double>::infinity();
          for (const Point& point : *points) {
            nearest = std::min(nearest, inwards.dot(point - v[i]));
          }
          EXPECT_LT(nearest, 1e-9);
        }
      }
    }
  }
}

TEST(ReachableSets, LongRandomPathsStayInTheSweptAreas) {
  constexpr unsigned kSeed = 42;
  SCOPED_TRACE(kSeed);
  std::mt19937 random(kSeed);
  for (int run = 0; run < 2000; ++run) {
    const TrimId start = pi(1 + random() % 12U);
    TrimId trim = start;
    Pose pose;
    for (std::size_t step = 1; step <= kLongSteps; ++step) {
      const auto edges = subgraph_b().successors(trim);
      const Edge& edge = edges[random() % edges.size()];
      const ConvexPolygon swept = transformed(edge.maneuver->swept_area_m, pose);
      for (const Point& corner : swept.vertices_m) {
        ASSERT_TRUE(contains(sets_b().swept_area_m(start, step), corner));
        ASSERT_TRUE(contains(sets_b().swept_area_until_m(start, step), corner));
        ASSERT_TRUE(contains(sets_b().swept_area_until_m(start, kLongSteps), corner));
      }
      pose = compose(pose, edge.maneuver->displacement);
      trim = edge.to;
    }
  }
}

TEST(ReachableSets, StepZeroIsTheFootprintWithMarginInBothHeadings) {
  const auto automaton = paper_automaton();
  for (const TrimId trim : subgraph_b().spec().trims) {
    const double yaw_rad = yaw_minus_heading_rad(automaton->trims[trim.index].steering_rad,
                                                 automaton->vehicle, automaton->identified);
    const ConvexPolygon& area = sets_b().swept_area_m(trim, 0);
    std::vector<Point> corners_m;
    for (const double heading_rad : {0.0, yaw_rad}) {
      const auto footprint =
          footprint_area(automaton->vehicle.footprint, {0.0, 0.0, heading_rad}, 0.010);
      corners_m.insert(corners_m.end(), footprint.vertices_m.begin(), footprint.vertices_m.end());
    }
    for (const Point& corner : corners_m) {
      EXPECT_TRUE(contains(area, corner));
    }
    const ConvexPolygon larger = inflated(convex_hull(corners_m), 1e-9);
    for (const Point& vertex : area.vertices_m) {
      EXPECT_TRUE(contains(larger, vertex));
    }
  }
}

}  // namespace
}  // namespace hlc::automaton
