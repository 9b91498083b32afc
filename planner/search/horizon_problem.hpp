#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "planner/automaton/reachable_sets.hpp"
#include "planner/automaton/subgraph.hpp"
#include "planner/geometry/polygon.hpp"

namespace hlc::search {

/// The receding-horizon problem: find n maneuvers (or self-loops of trims) from the start that end
/// in an equilibrium, whose areas meet no obstacle (while the vehicle moves, none of
/// `avoided_in_motion_m` either) and cross no boundary, and that minimise
///
///     sum_{j=1}^{n} || p_j - r_j ||^2 + (c_j . (p_j - r_j))^2   [m^2]
///
/// with p_j the position after step j and r_j the reference point of that step; in the paper
/// (Section 4) c_j = 0. With c_j = sqrt(w) n_j, n_j the unit normal of the reference path at r_j,
/// the error across the path (contouring error) counts 1 + w times as much as the error along it.
/// With SearchOptions::criterion_weights the maneuvers' own criteria are added (edge_costs.hpp).
/// The wheels of a standing vehicle are turned in the first step only (`turns_in_place`).
/// Coordinates are at most kLargest_m, the start's heading is at most kLargestHeading_rad.
struct HorizonProblem {
  static constexpr double kLargest_m = kLargestCoordinate_m;
  /// Neighbouring doubles are at most 1.2e-10 apart up to here, and ever farther beyond.
  static constexpr double kLargestHeading_rad = 1e6;

  Pose start;
  TrimId start_trim;
  std::vector<Point> reference_m;  ///< r_1 ... r_n; its size is the horizon n
  std::vector<Point> contouring;   ///< c_1 ... c_n [1]; empty: all are 0
  /// Of each step; needed only by the cost-to-go `kReferenceSpeed`, otherwise it may be empty.
  std::vector<double> reference_speed_mps;
  /// Areas that are occupied during step j (index j - 1), any number per step; empty: none at all.
  std::vector<std::vector<ConvexPolygon>> obstacles_m;
  /// Areas that maneuvers may not meet in step j, but that may come to a standing vehicle (passive
  /// motion safety): the self-loop of an equilibrium (`stands_in`) may meet them. Sizes as above.
  std::vector<std::vector<ConvexPolygon>> avoided_in_motion_m;
  std::vector<Segment> boundary_m;  ///< of the drivable area, the same for all steps
  /// No step may end in a trim near the steering limit (is_at_steering_limit), where a vehicle may
  /// drift from its plan.
  bool avoids_steering_limit{false};
  /// Whether the first step may turn the wheels of a standing vehicle. Not where the problem is the
  /// rest of another one, behind its first step; no file has such a problem.
  bool may_turn_in_place{true};
  /// A known plan, n maneuvers from the start: the plan in force, shifted by one step and ended in
  /// standstill. Empty if there is none. An engine checks it like any other path and ignores it if
  /// it is invalid; the best path is then never worse, and is found sooner.
  std::vector<const automaton::Maneuver*> incumbent;

  [[nodiscard]] std::size_t horizon_steps() const { return reference_m.size(); }
  /// Number `index` of the step's obstacles, from 0, then of what it avoids in motion.
  [[nodiscard]] const ConvexPolygon& area_m(std::size_t step, std::size_t index) const {
    const std::size_t always = obstacles_m.empty() ? 0 : obstacles_m[step - 1].size();
    return index < always ? obstacles_m[step - 1][index]
                          : avoided_in_motion_m[step - 1][index - always];
  }
  /// The cost of being at `position_m` after step `index` + 1 [m^2].
  [[nodiscard]] double position_cost_m2(std::size_t index, const Point& position_m) const {
    const Point error_m = position_m - reference_m[index];
    if (contouring.empty()) return error_m.squaredNorm();
    const double across = contouring[index].dot(error_m);
    return error_m.squaredNorm() + across * across;
  }
};

/// Whether the vehicle stands throughout the maneuver, so that it may meet what is avoided in
/// motion.
[[nodiscard]] inline bool stands_in(const automaton::Maneuver& maneuver) {
  return maneuver.from == maneuver.to && maneuver.displacement == Pose{};
}

/// Whether the maneuver turns the wheels of a vehicle that stands: it leads from one equilibrium to
/// another and moves nothing. (One that moves, as an optimum of J1 may, is an edge like all
/// others.)
///
/// When a standing vehicle turns its wheels makes no difference to the cost, so there would be as
/// many equally good plans of standing for k steps as there are ways to turn the wheels in k steps.
/// So only the first step of a plan may turn them. The rest of such a plan, followed by standing,
/// turns none (recursive feasibility).
[[nodiscard]] inline bool turns_in_place(const automaton::Maneuver& maneuver) {
  return maneuver.from != maneuver.to && maneuver.displacement == Pose{};
}

enum class CostToGo {
  /// Admissible and tight: the reachable sets of each trim (ReachableSets).
  kReachable,
  /// Admissible and textbook: every step leads at most as far as the longest maneuver.
  kStraightLine,
  /// `2022`, the authors' of 2022: sum (|| p - r_j || - v_ref step_s m)^2 without a floor at 0.
  /// Inadmissible; for the comparison with the paper only.
  kReferenceSpeed,
};

enum class Engine {
  kBranchAndBound,  ///< fast: depth-first (BranchAndBound)
  kBestFirst,       ///< plain: A* (BestFirstSearch), as reference and for study
};

/// Worth of one unit of a criterion against squared distance from the reference.
struct PlanningWeight {
  std::string criterion;  ///< as in Maneuver::criteria
  double weight_m2{};     ///< from 0 [m^2 per unit of the criterion]
  friend bool operator==(const PlanningWeight&, const PlanningWeight&) = default;
};

class SearchEngine;
struct SearchOptions;
struct SearchTables;

/// Makes an engine; parameters as make_search_engine.
using EngineFactory = std::unique_ptr<SearchEngine> (*)(const automaton::Subgraph& subgraph,
                                                        const automaton::ReachableSets& reachable,
                                                        const SearchOptions& options,
                                                        std::shared_ptr<const SearchTables> tables);

struct SearchOptions {
  /// Larger weights would bring costs near kNoPath.
  static constexpr double kMostWeight_m2 = 1e9;
  static constexpr std::size_t kMostExpansions = 1'000'000'000'000;

  Engine engine{Engine::kBranchAndBound};
  /// kStraightLine and kReferenceSpeed: with kBestFirst only.
  CostToGo cost_to_go{CostToGo::kReachable};
  /// Expansions after which the search stops; a number, never a time, so that two runs agree. The
  /// default exceeds every tree of the paper's automaton at horizon 8 (at most 309 029).
  std::size_t max_expansions{1'000'000};
  /// Adds the maneuvers' criteria to the planning cost: see edge_costs.hpp. In the paper, and
  /// without weights, it is the distance from the reference only.
  std::vector<PlanningWeight> criterion_weights{};
  /// Wraps `engine` in another interface, such as OMPL's (make_ompl_engine), or is a user's own
  /// engine. nullptr: `engine` itself.
  EngineFactory factory{nullptr};
};

enum class SearchStatus {
  kOptimal,   ///< a path of least cost
  kBudget,    ///< stopped early (max_expansions reached, or by request) with the best path so far
  kFallback,  ///< no path, see `reason`: the plan in force is to be driven on
  kUnproven,  ///< a path found with CostToGo::kReferenceSpeed, which is inadmissible: a better one
              ///< may exist
};

/// Why there is no path.
enum class NoPath {
  kNone,        ///< there is one
  kInfeasible,  ///< none exists
  kBudget,      ///< stopped before one was found
};

struct SearchResult {
  SearchStatus status{SearchStatus::kFallback};
  NoPath reason{NoPath::kInfeasible};
  double cost{};         ///< of the path [m^2]; 0 without one
  double lower_bound{};  ///< no path costs less [m^2]; the gap is cost - lower_bound
  std::vector<const automaton::Maneuver*> maneuvers;  ///< n of them; empty without a path
  std::vector<Pose> poses;                            ///< pose after each, n; empty without a path
  std::size_t generated{};                            ///< vertices generated, the root included
  std::size_t expanded{};                             ///< vertices whose successors were generated
};

}  // namespace hlc::search
