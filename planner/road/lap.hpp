#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "planner/road/reference_path.hpp"

namespace hlc::road {

/// A sequence of positions relative to a path.
struct Progress {
  std::vector<double> s_m;  ///< arc length, unwrapped: on a closed path it grows beyond the length
  std::vector<double> distance_m;  ///< to the path
};

/// Projects the positions one after another. The first is projected on the whole path (where
/// that drives a lane more than once, on the first of these places), each following one near the
/// place of its predecessor (within twice their distance and 0.1 m on either side), so that another
/// strand of the path that passes close by is never taken.
///
/// Arc length grows faster than the position moves where the path's curvature kappa turns towards a
/// position at distance e, by 1 / (1 - kappa e): twice covers e = 0.15 m at kappa = 3.3 1/m.
[[nodiscard]] Progress progress_along(const ReferencePath& path,
                                      std::span<const Point> positions_m);

/// Time from position `first` until the progress has reached s_first + length, linear between
/// positions [s]; nothing if it does not get there, or if the path is not closed.
/// @param times_s  time of each position, increasing
/// @pre as many times as positions
[[nodiscard]] std::optional<double> lap_s(const ReferencePath& path, const Progress& progress,
                                          std::span<const double> times_s, std::size_t first = 0);

/// Step in which a lap at the start of a run begins: in step 0 every vehicle stands, whatever it
/// plans; its first plan is driven from step 1 on.
inline constexpr std::size_t kFirstStepDriven = 1;

}  // namespace hlc::road
