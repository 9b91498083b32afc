#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "vehicle_sim/campaign/sweep.hpp"

namespace hlc::campaign {

/// Indices into SweepPlan::axes.
using Axes = std::vector<std::size_t>;

/// Axes with more values have no table by value.
inline constexpr std::size_t kMaxTableValues = 32;

/// The groupings of a sweep's tables: all combinations together (no axis), every axis of 2 ...
/// kMaxTableValues values alone, then the file's own `tables`.
[[nodiscard]] std::vector<Axes> groupings_of(const SweepPlan& plan);

/// The combinations with the same values on some axes.
struct SweepGroup {
  Axes axes;
  std::vector<std::string> values;  ///< of these axes
  std::vector<std::size_t> combinations;
};

/// The groups with any combination, in the order of the values.
[[nodiscard]] std::vector<SweepGroup> groups_of(const Sweep& sweep, const Axes& axes);

/// "drivable, search", "lanes, 2022": of a group without axes "all" and nothing.
[[nodiscard]] std::string settings_text(const SweepPlan& plan, const Axes& axes,
                                        const char* separator = ", ");
[[nodiscard]] std::string values_text(const SweepGroup& group, const char* separator = ", ");

/// Numbers of the runs, by combination.
[[nodiscard]] std::vector<std::vector<std::size_t>> runs_by_combination(const Sweep& sweep);

}  // namespace hlc::campaign
