#pragma once

#include <cstddef>
#include <vector>

#include "planner/maneuver_design/dominance.hpp"

namespace hlc::campaign {

/// The values of a fixed subgraph, or of a policy, in several quantities to be minimised.
struct TradeoffPoint {
  bool is_policy{};
  maneuver_design::Objectives values;
};

/// Competition of the fixed subgraphs and the policies.
struct TradeoffFront {
  std::vector<std::size_t> not_dominated;  ///< indices of points, ascending
  double fixed_volume{};                   ///< hypervolume of all fixed subgraphs together
  /// The same with one more point, by the index of the point: the gain of a policy over the free
  /// choice of a fixed subgraph before the run.
  std::vector<double> volume_with;
};

/// kReferenceFactor times the worst value of each quantity.
/// @pre points is not empty, no value below 0
[[nodiscard]] maneuver_design::Objectives reference_of(const std::vector<TradeoffPoint>& points);
inline constexpr double kReferenceFactor = 1.05;

[[nodiscard]] TradeoffFront front_of(const std::vector<TradeoffPoint>& points,
                                     const maneuver_design::Objectives& reference);

}  // namespace hlc::campaign
