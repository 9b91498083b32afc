#pragma once

#include <cstddef>

#include "planner/joint_search/joint_problem.hpp"

namespace hlc::joint_search {

struct JointSearchOptions {
  /// Expansions of all searches together after which no more nodes are taken; the searches of a
  /// node that has been taken are finished.
  std::size_t max_expansions{20'000'000};
};

struct JointSearchResult {
  /// kOptimal: plans of least cost. kBudget: the best ones found. kFallback: none, see `reason`.
  search::SearchStatus status{search::SearchStatus::kFallback};
  search::NoPath reason{search::NoPath::kInfeasible};
  JointPlan plans;         ///< empty without a plan
  double cost{};           ///< of all of them [m^2]; 0 without a plan
  double lower_bound{};    ///< no joint plan costs less [m^2]; 0 if none exists
  std::size_t nodes{};     ///< of the constraint tree, that were taken
  std::size_t expanded{};  ///< in all searches
};

/// Solves a joint problem exactly.
///
/// A node of the constraint tree forbids some points to some vehicles in some steps, and holds each
/// vehicle's optimum under these constraints, found by its own engine, which sees them as
/// obstacles; its bound is the sum of their costs. The node of least bound is taken. If no two of
/// its plans meet they are the joint optimum. Otherwise two of them, of a and b, share a point p in
/// some step j. No joint plan has both of them cover it, so each is found under one of two nodes:
/// with p forbidden in step j to a, or to b. (G. Sharon, R. Stern, A. Felner, N. R. Sturtevant,
/// "Conflict-based search for optimal multi-agent pathfinding", Artificial Intelligence 219, 2015;
/// there a vertex of a grid is forbidden.)
///
///   * Bounds: constraints only take plans away, so no joint plan under a node costs less than the
///     node's bound, and the least bound of the open nodes bounds them all.
///   * It ends: each constraint takes away the plan that it was made for, and a vehicle has
///     finitely many plans.
///   * Of a node's conflicts the one is taken whose cheaper child costs most, as all are tried.
///   * From each node plans are made in order (prioritized.hpp) under its constraints: so there is
///     an answer early.
///
/// An engine needs an area to keep clear of, so a forbidden point is a triangle of kPoint_m. Exact
/// are result and bound therefore among joint plans that pass each other at 2 kPoint_m and more;
/// found plans may overlap by kTouching_m2. A vehicle's search that uses up its own budget counts
/// with its lower bound.
///
/// Deterministic. @param incumbent  a known joint plan that solves the problem; may be empty
[[nodiscard]] JointSearchResult search_jointly(const JointProblem& problem,
                                               const JointSearchOptions& options = {},
                                               JointPlan incumbent = {});

inline constexpr double kPoint_m = 1e-6;

}  // namespace hlc::joint_search
