#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "planner/automaton/reachable_sets.hpp"
#include "planner/automaton/subgraph.hpp"
#include "planner/geometry/polygon.hpp"
#include "planner/search/frame.hpp"
#include "planner/search/horizon_problem.hpp"

namespace hlc::search {

/// Moves an area from the frame of its start into `placed` and returns its box. Allocates nothing
/// if `placed` has the capacity.
Box place(const ConvexPolygon& area_m, const Frame& start, ConvexPolygon& placed);

/// The first thing that a maneuver meets: an obstacle of its step, or the boundary.
struct Obstruction {
  /// In the step's obstacles, from 0, then those avoided in motion; none: the boundary.
  std::optional<std::size_t> obstacle;
  friend bool operator==(const Obstruction&, const Obstruction&) = default;
};

/// What CollisionCheck::is_free does not name; none if the maneuver is free. Without preparation,
/// so it is slower.
/// @param step   1 ... n: the step in which the maneuver is driven
/// @param start  pose at the begin of the maneuver
[[nodiscard]] std::optional<Obstruction> obstruction_of(const automaton::Maneuver& maneuver,
                                                        std::size_t step, const Frame& start,
                                                        const HorizonProblem& problem);

/// Collision check of the edges of one search: a maneuver is free in step j if its swept area meets
/// no obstacle of that step, unless the vehicle stands in it nothing that is avoided in motion, and
/// its lane area crosses no boundary segment.
///
/// `prepare` is called once per plan: it computes the obstacles' boxes and drops what no edge of
/// the plan can meet. Dropped are, per step, the obstacles whose box lies farther from the start
/// than
///
///     D + R,   D = ReachableSets::max_distance_m up to the begin of that step,
///              R = farthest point of any enabled maneuver's area from the maneuver's start,
///
/// and the boundary segments farther than the largest of these; so this changes no result for an
/// edge that a plan can hold. A check allocates nothing. Not safe for two threads at once.
class CollisionCheck {
 public:
  /// @param reachable  belongs to `subgraph` and must outlive this object
  CollisionCheck(const automaton::Subgraph& subgraph, const automaton::ReachableSets& reachable);

  /// @param problem  must stay unchanged until the last check
  /// @pre problem.obstacles_m and avoided_in_motion_m are empty or have one entry per step
  void prepare(const HorizonProblem& problem);

  /// @param step   1 ... n: the step in which the maneuver is driven
  /// @param start  pose at the begin of the maneuver
  [[nodiscard]] bool is_free(const automaton::Maneuver& maneuver, std::size_t step,
                             const Frame& start);

 private:
  struct Obstacle {
    Box box;
    const ConvexPolygon* polygon_m;
  };
  struct BoundaryPiece {
    Box box;
    Segment segment;
  };

  [[nodiscard]] bool meets_obstacle(const automaton::Maneuver& maneuver, std::size_t step,
                                    const Frame& start);
  void add_obstacles(const std::vector<ConvexPolygon>& areas_m, const Point& start_m,
                     double reach_m, std::vector<Obstacle>& obstacles) const;
  [[nodiscard]] bool meets_boundary(const ConvexPolygon& area_m, const Frame& start);
  const automaton::ReachableSets& reachable_;
  double area_radius_m_{};  ///< farthest point of any maneuver's area from its start
  std::vector<std::vector<Obstacle>> obstacles_;
  std::vector<std::vector<Obstacle>> avoided_in_motion_;
  std::vector<BoundaryPiece> boundary_;
  ConvexPolygon placed_;  ///< its capacity holds the largest area
};

}  // namespace hlc::search
