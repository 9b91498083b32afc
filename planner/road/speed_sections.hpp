#pragma once

#include <span>
#include <vector>

#include "planner/road/reference_path.hpp"

namespace hlc::road {

/// A part of a path on which no reference is faster.
struct SpeedSection {
  double from_s_m{};  ///< in [0, length)
  double to_s_m{};    ///< > from_s_m; on a closed path perhaps beyond its length, by less than it
  double speed_mps{};
};

/// The least of the speed and those of the sections that the path passes between two places.
/// @param from_s_m, to_s_m  from < to; on a closed path meant modulo its length
[[nodiscard]] double least_speed_mps(std::span<const SpeedSection> sections,
                                     const ReferencePath& path, double from_s_m, double to_s_m,
                                     double speed_mps);

/// The sections of `path_until(path, end_s_m)` (goal.hpp): those of a closed path again in each
/// lap, without what lies beyond the end.
[[nodiscard]] std::vector<SpeedSection> sections_until(std::span<const SpeedSection> sections,
                                                       const ReferencePath& path, double end_s_m);

}  // namespace hlc::road
