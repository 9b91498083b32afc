#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "vehicle_sim/campaign/sweep_settings.hpp"

namespace hlc::campaign {

/// Values that a setting takes.
struct SweepAxis {
  std::string setting;
  std::vector<SweepValue> values;
};

/// The settings with their values, and the runs of each combination.
struct SweepPlan {
  std::filesystem::path file;
  std::vector<std::filesystem::path> scenarios;  ///< all on the same automaton
  std::filesystem::path automaton;               ///< its configuration
  std::vector<std::string> subgraphs;
  std::size_t starts{1};
  std::uint64_t seed{1};
  std::optional<std::size_t> steps;  ///< instead of the scenarios'
  std::optional<std::size_t> runs;   ///< none: the whole grid
  std::vector<SweepAxis> axes;       ///< in the order of sweep_settings()
  /// Axes by which results are grouped together; single axes need no entry.
  std::vector<std::vector<std::size_t>> tables;

  /// Runs per combination: scenarios x subgraphs x starts.
  [[nodiscard]] std::size_t runs_each() const {
    return scenarios.size() * subgraphs.size() * starts;
  }
};

/// Reads a sweep file. Paths are relative to it. Keys:
///
///     scenarios:  list of scenario files, all with the same automaton, a configuration
///     subgraphs:  list of names
///     starts:     (default 1) as `evaluate --starts`: the scenario's own, then random ones
///     seed:       (default 1) of the random starts and of the sample
///     steps:      (default: the scenarios')
///     runs:       absent: every combination of the values (grid); else a random sample of
///                 different combinations, so many that there are at least as many runs, or all
///     settings:   map of names (sweep_settings.hpp), each with a list of different values
///     tables:     (default none) list of lists of settings; the reports also group results by the
///                 values of each list's settings together
///
/// Every combination is driven in every scenario, with every subgraph, from every start.
///
/// @throws std::invalid_argument with one line, "file:line: key = value, must be ..."
[[nodiscard]] SweepPlan read_sweep(const std::filesystem::path& file);

/// For each axis of the plan the index of its value.
using SweepCombination = std::vector<std::size_t>;

/// The driven combinations: of a grid all, the last axis changing first; of a sample those drawn,
/// in the order of the grid. The same plan gives the same combinations.
[[nodiscard]] std::vector<SweepCombination> combinations_of(const SweepPlan& plan);

/// The value that the combination gives a setting; nullptr if the plan does not set it.
[[nodiscard]] const SweepValue* value_of(const SweepPlan& plan, const SweepCombination& combination,
                                         const std::string& setting);

}  // namespace hlc::campaign
