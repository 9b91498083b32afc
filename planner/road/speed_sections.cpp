#include "planner/road/speed_sections.hpp"

#include <algorithm>
#include <cmath>

#include "planner/common/demand.hpp"

namespace hlc::road {
namespace {

/// The section so many laps later.
SpeedSection in_lap(const SpeedSection& section, double lap, double length_m) {
  return {section.from_s_m + lap * length_m, section.to_s_m + lap * length_m, section.speed_mps};
}

}  // namespace

double least_speed_mps(std::span<const SpeedSection> sections, const ReferencePath& path,
                       double from_s_m, double to_s_m, double speed_mps) {
  HLC_DEMAND(from_s_m < to_s_m, from_s_m, to_s_m);
  const double length_m = path.length_m();
  for (const SpeedSection& section : sections) {
    // On a closed path the last lap in which the section begins before `to_s_m`: those before end
    // earlier.
    const double lap =
        path.is_closed() ? std::ceil((to_s_m - section.from_s_m) / length_m) - 1.0 : 0.0;
    const SpeedSection here = in_lap(section, lap, length_m);
    if (here.from_s_m < to_s_m && here.to_s_m > from_s_m) {
      speed_mps = std::min(speed_mps, section.speed_mps);
    }
  }
  return speed_mps;
}

std::vector<SpeedSection> sections_until(std::span<const SpeedSection> sections,
                                         const ReferencePath& path, double end_s_m) {
  const double length_m = path.length_m();
  const double laps = path.is_closed() ? std::ceil(end_s_m / length_m) : 1.0;
  std::vector<SpeedSection> until;
  // Around the begin of a closed path a section of the lap before goes on.
  for (double lap = path.is_closed() ? -1.0 : 0.0; lap < laps; lap += 1.0) {
    for (const SpeedSection& section : sections) {
      SpeedSection here = in_lap(section, lap, length_m);
      here.from_s_m = std::max(here.from_s_m, 0.0);
      here.to_s_m = std::min(here.to_s_m, end_s_m);
      if (here.from_s_m < here.to_s_m) until.push_back(here);
    }
  }
  return until;
}

}  // namespace hlc::road
