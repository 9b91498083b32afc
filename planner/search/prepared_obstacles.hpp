#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "planner/automaton/reachable_sets.hpp"
#include "planner/search/branch_and_bound_data.hpp"
#include "planner/search/horizon_problem.hpp"

namespace hlc::branch_and_bound {

/// Obstacles and boundary of one problem in flat arrays, for the kernel of BranchAndBound.
///
/// Left out is what lies beyond one of the eight half-planes of ReachableSets::reach for the begin
/// of the step, moved outwards by R, the farthest point of any area from its maneuver's start: no
/// edge of a plan can meet it in that step. Of a boundary segment counts the first step in which it
/// is not left out.
class PreparedObstacles {
 public:
  /// @param area_radius_m  R
  PreparedObstacles(const ReachableSets& reachable, double area_radius_m)
      : reachable_(reachable), area_radius_m_(area_radius_m) {}

  /// @param problem  must stay unchanged as long as the arrays are used
  void prepare(const HorizonProblem& problem);

  /// Fills what concerns obstacles and boundary. Valid until the next `prepare`.
  void view(Plan& plan) const;
  /// Corners of the largest obstacle, padded.
  [[nodiscard]] std::size_t most_corners() const { return most_corners_; }

  [[nodiscard]] const ConvexPolygon& obstacle(std::uint32_t item) const { return *sources_[item]; }
  [[nodiscard]] const Segment& segment(std::uint32_t item) const;

 private:
  /// What areas can reach in a step: half-planes n_i p <= offset_i.
  struct HalfPlanes {
    std::array<double, 8> x;
    std::array<double, 8> y;
    std::array<double, 8> offset;
  };

  void make_room(const HorizonProblem& problem);
  void find_reach(const HorizonProblem& problem);
  void add_obstacle(const ConvexPolygon& polygon_m, const HalfPlanes& reach);
  void pad_step();
  void add_segments(const HorizonProblem& problem);

  const ReachableSets& reachable_;
  double area_radius_m_;
  std::vector<HalfPlanes> reach_;  ///< by step
  double scale_m_{};               ///< largest coordinate
  std::size_t num_obstacles_{};
  std::size_t num_corners_{};
  std::size_t most_corners_{};
  std::vector<std::uint32_t> first_obstacle_;
  std::vector<double> circle_x_;
  std::vector<double> circle_y_;
  std::vector<double> circle_radius_;
  std::vector<ObstacleData> obstacles_;
  std::vector<const ConvexPolygon*> sources_;
  std::vector<double> x_;
  std::vector<double> y_;
  std::vector<double> normal_x_;
  std::vector<double> normal_y_;
  std::vector<double> offset_;
  std::vector<std::uint32_t> num_segments_;
  std::vector<std::uint32_t> first_step_;      ///< of each boundary segment
  std::vector<std::uint32_t> segment_source_;  ///< its number in the problem
  const HorizonProblem* problem_{};
  std::vector<double> from_x_;
  std::vector<double> from_y_;
  std::vector<double> to_x_;
  std::vector<double> to_y_;
};

}  // namespace hlc::branch_and_bound
