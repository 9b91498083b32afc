#pragma once

#include <cstddef>
#include <variant>
#include <vector>

#include "planner/automaton/subgraph_request.hpp"
#include "planner/search/horizon_problem.hpp"

namespace hlc {

/// A part of the map in which nobody drives faster: a rectangle in the map's frame.
struct SpeedZone {
  double min_x_m{};
  double max_x_m{};
  double min_y_m{};
  double max_y_m{};
  double max_speed_mps{};
  friend bool operator==(const SpeedZone&, const SpeedZone&) = default;
};

/// Asks for something else from given times on.
struct TimePolicySettings {
  struct Change {
    double from_s{};  ///< since the experiment's first step
    SubgraphRequest request;
    friend bool operator==(const Change&, const Change&) = default;
  };
  std::vector<Change> changes;  ///< by time, each once; before the first: no opinion
  friend bool operator==(const TimePolicySettings&, const TimePolicySettings&) = default;
};

/// Asks for one thing on open road, and for another where vehicles may meet or no new plan came
/// into force.
struct SituationPolicySettings {
  SubgraphRequest open_road;
  SubgraphRequest conflict;
  double after_conflict_s{1.0};  ///< so much longer it takes for a conflict; >= 0
  friend bool operator==(const SituationPolicySettings&, const SituationPolicySettings&) = default;
};

/// Asks for something while the battery is weak; no opinion otherwise.
struct BatteryPolicySettings {
  double below_v{};
  double back_above_v{};  ///< >= below_v
  SubgraphRequest request;
  friend bool operator==(const BatteryPolicySettings&, const BatteryPolicySettings&) = default;
};

/// Asks for what a rollout of the next steps cost least with (look_ahead.hpp).
struct LookAheadSettings {
  std::vector<SubgraphRequest> candidates;  ///< at least two
  std::size_t steps{8};
  std::vector<PlanningWeight> criterion_weights;
  /// Something else is asked for only if it costs less than this share less; in [0, 1).
  double least_gain{0.05};
  std::size_t max_expansions{};  ///< of each search in a rollout (LookAheadRolloutSettings)
  friend bool operator==(const LookAheadSettings&, const LookAheadSettings&) = default;
};

/// All candidates, steps and expansions of one look-ahead multiplied: it is done after a step's
/// command, in what is left of the step. The slowest searches measured (`propose_budget`, every
/// maneuver of 16 trims, a busy core) take a tenth of a second for so many.
inline constexpr std::size_t kMostLookAheadExpansions = 40'000;

using PolicySettings = std::variant<TimePolicySettings, SituationPolicySettings,
                                    BatteryPolicySettings, LookAheadSettings>;

/// Stands for no zones and no policies where a name is asked for.
inline constexpr const char* kNoPolicy = "none";

/// Which subgraph a vehicle's controller plans on, if nobody asks it from outside.
struct ReconfigurationSettings {
  std::vector<SpeedZone> zones;
  std::vector<PolicySettings> policies;  ///< of several with an opinion the first one counts
  /// What a policy has asked for stays at least so long, so that it does not flicker, unless a
  /// policy before it in the list has an opinion: at most two changes in that time; >= 0.
  double min_stay_s{1.0};
  friend bool operator==(const ReconfigurationSettings&, const ReconfigurationSettings&) = default;
};

}  // namespace hlc
