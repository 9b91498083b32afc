#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "planner/search/branch_and_bound/data.hpp"
#include "planner/search/branch_and_bound/tables.hpp"
#include "planner/search/horizon_problem.hpp"

namespace hlc::search::branch_and_bound {

/// Memory for the obstacles and the boundary of one problem, for the kernel of BranchAndBound.
///
/// The kernel drops what lies beyond one of the half-planes of TableStore::reach for the step: no
/// edge of a plan can meet it in that step. Eight consecutive boundary segments are dropped if they
/// lie beyond one in every step. Equal consecutive obstacles of a step are merged.
class PreparedObstacles {
 public:
  explicit PreparedObstacles(const TableStore& tables) : tables_(tables) {}

  /// Lists the problem's obstacles and boundary in `plan` and gives the plan memory for the
  /// kernel's remaining part. Valid until the next call.
  /// @param problem  must stay unchanged as long as the plan is used
  void list(const HorizonProblem& problem, Plan& plan);

  /// Room for all obstacles of any step, once per vertex of a path.
  [[nodiscard]] std::uint32_t* near(std::size_t depth) { return &near_[depth * most_in_step_]; }
  [[nodiscard]] PolygonBlock* near_blocks(std::size_t depth) {
    return &near_blocks_[depth * most_in_step_];
  }

  /// The obstacle or segment of the problem for one of the plan.
  [[nodiscard]] const ConvexPolygon& obstacle(std::uint32_t item) const {
    const PolygonData& polygon = polygons_[obstacles_[item].polygon];
    const auto& areas_m =
        polygon.only_in_motion ? problem_->avoided_in_motion_m : problem_->obstacles_m;
    return areas_m[polygon.step][polygon.number];
  }
  [[nodiscard]] const Segment& segment(std::uint32_t item) const {
    const std::size_t number = segment_source_[item / kFloatLanes] + item % kFloatLanes;
    return problem_->boundary_m[std::min(number, problem_->boundary_m.size() - 1)];
  }

 private:
  void list_polygons();
  /// Those of a step (from 0), at the end of the list.
  void list_polygons(const std::vector<ConvexPolygon>& areas_m, std::size_t step,
                     bool only_in_motion);

  const TableStore& tables_;
  const HorizonProblem* problem_{};
  std::size_t num_polygons_{};
  std::size_t num_pieces_{};
  std::size_t most_in_step_{};  ///< pieces
  std::vector<PolygonData> polygons_;
  std::vector<const double*> reach_;
  std::vector<std::uint32_t> first_obstacle_;
  std::vector<std::uint32_t> last_obstacle_;
  std::vector<std::uint32_t> first_in_motion_;
  std::vector<PieceData> obstacles_;
  std::vector<BoxesBlock> obstacle_boxes_;
  std::vector<std::uint32_t> near_;
  std::vector<PolygonBlock> near_blocks_;
  std::vector<PolygonBlock> obstacle_blocks_;
  std::vector<std::uint32_t> segment_source_;
  std::vector<SegmentBlock> segment_blocks_;
  std::vector<SegmentRectanglesBlock> segment_rectangles_;
};

}  // namespace hlc::search::branch_and_bound
