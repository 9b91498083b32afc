#pragma once

#include <nlohmann/json.hpp>

#include "vehicle_sim/campaign/run_figures.hpp"

namespace hlc {

/// The figures of a run as they stand in runs.jsonl: an object with a key for each number of
/// RunFigures, null where there is none. Times are left out if nobody measured them.
[[nodiscard]] nlohmann::ordered_json figures_record(const RunFigures& figures);

/// The heading with the figures of such an object.
/// @throws nlohmann::json::exception if it is none
[[nodiscard]] RunFigures read_figures(const nlohmann::ordered_json& record, RunFigures heading);

/// The heading with what a whole record of runs.jsonl says: `failure`, null or a reason, and
/// `figures`, which only a run that could not be driven to its end has not.
/// @throws nlohmann::json::exception if it is none
[[nodiscard]] RunFigures figures_of_record(const nlohmann::ordered_json& record,
                                           RunFigures heading);

}  // namespace hlc
