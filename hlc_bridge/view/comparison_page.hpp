#pragma once

#include <optional>
#include <string>

#include "hlc_bridge/result/run_comparison.hpp"
#include "planner/road/lanelet_map.hpp"

namespace hlc::view {

/// Two compared runs as one page without scripts that loads nothing: the lines and tables of
/// result::comparison_text, and a picture of the lanes and the driven paths of all vehicles: one
/// colour per vehicle, the first run wide and pale, the second one narrow and dashed, a ring where
/// the runs begin to differ. Light or dark as the browser prefers. Names are escaped.
///
/// Paths are drawn from t(k0) to the end of the record, to 1 mm, positions every 20 mm.
/// @param map_a, map_b  none: open ground; the lanes of the second are drawn, dashed, if they
/// differ from the first's
[[nodiscard]] std::string comparison_page(const result::RunComparison& comparison,
                                          const std::optional<road::LaneletMap>& map_a,
                                          const std::optional<road::LaneletMap>& map_b);

}  // namespace hlc::view
