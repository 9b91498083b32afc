#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "planner/automaton/reachable_sets.hpp"
#include "planner/automaton/subgraph.hpp"
#include "planner/search/branch_and_bound/data.hpp"
#include "planner/search/edge_costs.hpp"
#include "planner/search/frame.hpp"

namespace hlc::search::branch_and_bound {

/// Number of blocks for this many corners or segments.
[[nodiscard]] constexpr std::size_t blocks_of(std::size_t size) {
  return (size + kFloatLanes - 1) / kFloatLanes;
}

/// The kernel's data of a subgraph, computed once: edges with their areas, bounds, and permissions
/// (see BranchAndBound and data.hpp).
class TableStore {
 public:
  /// @pre reachable.max_steps() <= kMostSteps
  TableStore(const automaton::Subgraph& subgraph, const automaton::ReachableSets& reachable,
             const EdgeCosts& costs);
  TableStore(const TableStore&) = delete;  // it refers to itself
  TableStore& operator=(const TableStore&) = delete;

  /// The rounding of a bound is known for at most this many steps (see the implementation).
  static constexpr std::size_t kMostSteps = 80;

  [[nodiscard]] const Tables& view() const { return view_; }
  /// Which edges a depth excludes beside those from which a plan cannot end in standstill.
  struct Excluded {
    bool at_limit{};          ///< those into trims near the steering limit
    bool turning_in_place{};  ///< `turns_in_place`
  };
  /// The depth with `steps_left` steps after an edge from it.
  [[nodiscard]] const Level& level(std::size_t steps_left, const Excluded& excluded) const {
    return levels_[number_of(excluded)][steps_left];
  }
  /// The maneuver of an edge; nullptr for padding.
  [[nodiscard]] const automaton::Maneuver* maneuver(std::uint32_t edge) const {
    return maneuvers_[edge];
  }
  /// Number of the edge out of `trim` with this maneuver; kNoEdge if there is none.
  [[nodiscard]] std::uint32_t find(TrimId trim, const automaton::Maneuver* maneuver) const;
  static constexpr std::uint32_t kNoEdge = static_cast<std::uint32_t>(-1);
  static constexpr std::size_t kReachSize = 2 * kAxes;

  /// Range of the areas of the step after `steps` steps, as in Plan::reach: the half-planes of
  /// ReachableSets::reach moved outwards by the farthest corner of any area from the start of its
  /// maneuver.
  [[nodiscard]] const double* reach(TrimId trim, std::size_t steps, std::size_t steps_left) const;
  /// Largest distance of any corner of an area of the first `steps` steps, and of any vertex, from
  /// the start [m].
  [[nodiscard]] double reach_m(std::size_t steps) const {
    return static_cast<double>(steps) * area_radius_m_;
  }
  /// The longest displacement of an edge.
  [[nodiscard]] double longest_m() const { return longest_m_; }
  /// Up to this distance from a vertex a coordinate along an axis fits into 16 bits.
  [[nodiscard]] double counted_m() const { return counted_m_; }
  /// Most edges out of one trim, padded.
  [[nodiscard]] std::size_t most_edges() const { return most_edges_; }

 private:
  static constexpr std::array<Excluded, 4> kChoices{
      {{false, false}, {true, false}, {false, true}, {true, true}}};
  /// Its place among kChoices.
  [[nodiscard]] static std::size_t number_of(const Excluded& excluded) {
    return (excluded.at_limit ? 1U : 0U) + (excluded.turning_in_place ? 2U : 0U);
  }

  void add_edges(const automaton::Subgraph& subgraph, const EdgeCosts& costs);
  /// A rectangle around the swept areas of a trim's edges.
  void add_surroundings(std::span<const automaton::Edge> successors);
  [[nodiscard]] EdgeData edge_data(const automaton::Edge& edge, const Frame& displacement,
                                   const EdgeCosts& costs);
  [[nodiscard]] LaneArea add_lane_area(const ConvexPolygon& area_m);
  void add_blocks(std::span<const Point> corners);
  void list_permitted(const automaton::Subgraph& subgraph, const EdgeCosts& costs,
                      std::size_t max_steps);
  /// Chooses the unit of bounds, and of the edges' displacements.
  void choose_unit();
  void compute_bounds(const automaton::ReachableSets& reachable);
  void list_levels(std::size_t max_steps);
  void list_reach(const automaton::Subgraph& subgraph, const automaton::ReachableSets& reachable);
  [[nodiscard]] std::size_t reach_row(TrimId trim, std::size_t steps, std::size_t steps_left) const;

  std::vector<const automaton::Maneuver*> maneuvers_;
  std::vector<EdgeData> edges_;
  std::vector<std::uint32_t> first_group_;
  std::vector<double> displacement_x_;
  std::vector<double> displacement_y_;
  std::vector<BoundBlock> bounds_;
  std::vector<std::vector<std::uint32_t>> bound_places_;  ///< Level::bounds, by steps left
  std::array<std::vector<Level>, kChoices.size()> levels_;
  std::array<std::vector<double>, kChoices.size()> penalty_;
  std::array<std::vector<std::uint32_t>, kChoices.size()> permitted_;
  std::vector<PolygonBlock> area_blocks_;
  std::vector<LaneArea> lane_areas_;
  std::vector<Surroundings> around_;
  std::vector<double> reach_;
  std::size_t reach_steps_{};
  std::vector<double> numbers_;
  double longest_m_{};
  double counted_m_{};
  double area_radius_m_{};  ///< farthest corner of any area, or end, from its maneuver's start
  std::size_t num_trims_{};
  std::size_t max_steps_left_{};
  std::size_t most_edges_{};
  std::size_t num_bound_blocks_{};  ///< fours of steps after an edge
  std::size_t penalty_rows_{};      ///< by steps left, the last row for all that are more
  Tables view_{};
};

}  // namespace hlc::search::branch_and_bound
