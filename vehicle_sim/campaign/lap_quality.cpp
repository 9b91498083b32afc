#include "vehicle_sim/campaign/lap_quality.hpp"

namespace hlc::campaign {

std::optional<LapQuality> lap_quality(const std::vector<const RunFigures*>& runs) {
  LapQuality quality;
  const auto count = static_cast<double>(runs.size());
  for (const RunFigures* run : runs) {
    if (!has_lap(*run)) return std::nullopt;
    quality.error_mean_mm += *run->error_mean_mm / count;
    quality.lap_s += *run->lap_s / count;
    quality.generated_max += run->generated_max / count;
  }
  return quality;
}

}  // namespace hlc::campaign
