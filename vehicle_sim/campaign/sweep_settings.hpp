#pragma once

#include <functional>
#include <string>
#include <vector>

#include "planner/common/node.hpp"
#include "planner/maneuver_design/automaton_configuration.hpp"
#include "planner/scenario/scenario.hpp"

namespace hlc::campaign {

/// One value of a setting.
struct SweepValue {
  std::string text;           ///< as it is printed: "12", "lanes", "1 2 4 6"
  double number{};            ///< of a setting that is a number
  std::vector<TrimId> trims;  ///< of the setting `trims`, sorted
};

/// A setting that a sweep can change, and its effect. A run without it uses the files' value.
///
/// | name                  | value                                                               |
/// |-----------------------|---------------------------------------------------------------------|
/// | `profile`             | `default`, `2022`; the next three replace single rules of it        |
/// | `coordination`        | `cooperative`, `strict`, `agreed`: scenario key                     |
/// | `reference_rule`      | `2022`, `later`: spacing of the reference points                    |
/// | `search`              | `branch_and_bound`, `best_first` (both optimal), `2022` (the        |
/// |                       | authors' cost-to-go, inadmissible)                                  |
/// | `reference_speed_mps` | > 0                                                                 |
/// | `contouring_weight`   | 0 to 10 000: scenario key; also of held-up vehicles                 |
/// | `drivable`            | `lanes`, `everywhere`: no lane bounds                               |
/// | `acceleration_mps2`   | > 0: the automaton's limit                                          |
/// | `steering_rate_radps` | > 0: the automaton's limit                                          |
/// | `speed_max_mps`       | > 0: the automaton's limit                                          |
/// | `own_steps`           | `trim`, `optimised`, `optimised_all`: a trim's step back to itself  |
/// | `wheelbase_m`         | > 0; the centre of gravity keeps its place between the axles        |
/// | `width_m`             | > 0: the footprint's                                                |
/// | `safety_margin_m`     | >= 0: vehicle to vehicle                                            |
/// | `trims`               | which trims are on in every subgraph of the sweep, standstill       |
/// |                       | always: lists of numbers from 1, or the word `subsets`: every       |
/// |                       | choice of at least one moving trim                                  |
/// | `vehicle`             | `identified`: the lab's; `exact`: always where the plan is          |
/// |                       | (exact_run.hpp)                                                     |
/// | `lap`                 | `standing`: a run is judged from its first step on; `flying`: from  |
/// |                       | step 10 on (lap, errors and vertices)                               |
struct SweepSetting {
  std::string name;
  bool is_number{};
  Allowed allowed;
  /// Absent: the setting does not change the automaton.
  std::function<void(const SweepValue&, maneuver_design::AutomatonConfiguration&)> on_automaton;
  /// Absent: the setting does not change the scenario after it is read with its profile.
  std::function<void(const SweepValue&, scenario::Scenario&)> on_scenario;
};

/// All, in the order of the table: a later setting prevails.
[[nodiscard]] const std::vector<SweepSetting>& sweep_settings();

inline constexpr char kProfileSetting[] = "profile";
inline constexpr char kTrimsSetting[] = "trims";
inline constexpr char kVehicleSetting[] = "vehicle";
inline constexpr char kExactVehicle[] = "exact";
inline constexpr char kLapSetting[] = "lap";
/// The first step that counts for a flying lap: by then every car is at speed.
inline constexpr std::uint64_t kFlyingStep = 10;

}  // namespace hlc::campaign
