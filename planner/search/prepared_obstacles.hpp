#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "planner/search/branch_and_bound_data.hpp"
#include "planner/search/branch_and_bound_tables.hpp"
#include "planner/search/horizon_problem.hpp"

namespace hlc::branch_and_bound {

/// Memory for the obstacles and the boundary of one problem, for the kernel of BranchAndBound.
///
/// The kernel leaves out what lies beyond one of the half-planes of TableStore::reach for the step:
/// no edge of a plan can meet it in that step. Boundary segments are left out if this is so for
/// every step.
class PreparedObstacles {
 public:
  explicit PreparedObstacles(const TableStore& tables) : tables_(tables) {}

  /// Lists the problem's obstacles and boundary in `plan` and gives it memory for what the kernel
  /// keeps of them. Valid until the next call.
  /// @param problem  must stay unchanged as long as the plan is used
  void list(const HorizonProblem& problem, Plan& plan);

  /// Corners of the largest obstacle, padded.
  [[nodiscard]] std::size_t most_corners() const { return most_corners_; }
  /// What an obstacle or a segment of the plan is in the problem.
  [[nodiscard]] const ConvexPolygon& obstacle(std::uint32_t item) const {
    return *sources_[obstacles_[item].polygon];
  }
  [[nodiscard]] const Segment& segment(std::uint32_t item) const {
    return problem_->boundary_m[segment_source_[item]];
  }

 private:
  void list_polygons();

  const TableStore& tables_;
  const HorizonProblem* problem_{};
  std::size_t most_corners_{};
  std::vector<PolygonData> polygons_;
  std::vector<const ConvexPolygon*> sources_;  ///< of `polygons_`
  std::vector<const double*> reach_;
  std::vector<std::uint32_t> first_obstacle_;
  std::vector<ObstacleData> obstacles_;
  std::vector<double> circles_;  ///< x, y, radius
  std::vector<double> corners_;  ///< x, y, normal x, normal y, offset
  std::vector<std::uint32_t> segment_source_;
  std::vector<double> segments_;  ///< from x, from y, to x, to y
  std::vector<double> blocks_;    ///< x, y, half length x, y, half width
};

}  // namespace hlc::branch_and_bound
