#pragma once

#include <cstddef>
#include <variant>
#include <vector>

#include "planner/automaton/subgraph_request.hpp"
#include "planner/search/horizon_problem.hpp"

namespace hlc::policy {

/// A part of the map with a speed limit: a rectangle in the map's frame.
struct SpeedZone {
  double min_x_m{};
  double max_x_m{};
  double min_y_m{};
  double max_y_m{};
  double max_speed_mps{};
  friend bool operator==(const SpeedZone&, const SpeedZone&) = default;
};

/// Proposes requests from given times on.
struct TimePolicySettings {
  struct Change {
    double from_s{};  ///< since the experiment's first step
    SubgraphRequest request;
    friend bool operator==(const Change&, const Change&) = default;
  };
  std::vector<Change> changes;  ///< by time, each once; before the first: no opinion
  friend bool operator==(const TimePolicySettings&, const TimePolicySettings&) = default;
};

/// Proposes one request on open road, and another where vehicles may meet or no new plan came into
/// force.
struct SituationPolicySettings {
  SubgraphRequest open_road;
  SubgraphRequest conflict;
  double after_conflict_s{1.0};  ///< a situation counts as conflict this long after it ends; >= 0
  friend bool operator==(const SituationPolicySettings&, const SituationPolicySettings&) = default;
};

/// Proposes a request while the battery is weak; no opinion otherwise.
struct BatteryPolicySettings {
  double below_v{};
  double back_above_v{};  ///< >= below_v
  SubgraphRequest request;
  friend bool operator==(const BatteryPolicySettings&, const BatteryPolicySettings&) = default;
};

/// Proposes the candidate whose look-ahead rollout costs least (look_ahead.hpp).
struct LookAheadSettings {
  std::vector<SubgraphRequest> candidates;  ///< at least two
  std::size_t steps{8};
  std::vector<search::PlanningWeight> criterion_weights;
  /// Another candidate is proposed only if it costs less by at least this share; in [0, 1).
  double least_gain{0.05};
  std::size_t max_expansions{};  ///< of each search in a rollout (LookAheadRolloutSettings)
  friend bool operator==(const LookAheadSettings&, const LookAheadSettings&) = default;
};

/// Product of candidates, steps and expansions of one look-ahead: it runs after a step's command,
/// in the rest of the step. The slowest searches measured (`propose_budget`, every maneuver of 16
/// trims, a busy core) take a tenth of a second for this many.
inline constexpr std::size_t kMostLookAheadExpansions = 40'000;

using PolicySettings = std::variant<TimePolicySettings, SituationPolicySettings,
                                    BatteryPolicySettings, LookAheadSettings>;

/// Name for no zones and no policies.
inline constexpr const char* kNoPolicy = "none";

/// What the limit of a zone holds for.
enum class ZonesLimit {
  kSubgraph,   ///< every trim that is planned on, and so the reference
  kReference,  ///< the reference only: plans may be faster
};

/// How a vehicle's controller chooses its subgraph without external requests.
struct ReconfigurationSettings {
  std::vector<SpeedZone> zones;
  ZonesLimit zones_limit{ZonesLimit::kSubgraph};  ///< of all zones
  std::vector<PolicySettings> policies;  ///< of several with an opinion the first one counts
  /// A proposal stays at least this long, so that the subgraph does not flicker, unless a policy
  /// before it in the list has an opinion: at most two changes in that time; >= 0.
  double min_stay_s{1.0};
  friend bool operator==(const ReconfigurationSettings&, const ReconfigurationSettings&) = default;
};

}  // namespace hlc::policy
