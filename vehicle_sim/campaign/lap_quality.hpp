#pragma once

#include <optional>
#include <vector>

#include "vehicle_sim/campaign/run_figures.hpp"

namespace hlc::campaign {

/// Quality of driven laps: means over runs.
struct LapQuality {
  double error_mean_mm{};
  double lap_s{};
  double generated_max{};
};

/// Over runs that differ in their starts; nothing if one of them does not count or drove no lap.
[[nodiscard]] std::optional<LapQuality> lap_quality(const std::vector<const RunFigures*>& runs);

}  // namespace hlc::campaign
