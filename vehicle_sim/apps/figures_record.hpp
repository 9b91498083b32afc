#pragma once

#include <nlohmann/json.hpp>

#include "vehicle_sim/campaign/run_figures.hpp"

namespace hlc::apps {

/// The figures of a run as in runs.jsonl: an object with a key for each number of RunFigures, null
/// where there is none. Times that were not measured are left out.
[[nodiscard]] nlohmann::ordered_json figures_record(const campaign::RunFigures& figures);

/// The heading with the figures of such an object.
/// @throws nlohmann::json::exception if `record` is not such an object
[[nodiscard]] campaign::RunFigures read_figures(const nlohmann::ordered_json& record,
                                                campaign::RunFigures heading);

/// The heading with the content of a whole record of runs.jsonl: `failure`, null or a reason, and
/// `figures`, which is absent only for a run that could not be driven to its end.
/// @throws nlohmann::json::exception if `record` is not such a record
[[nodiscard]] campaign::RunFigures figures_of_record(const nlohmann::ordered_json& record,
                                                     campaign::RunFigures heading);

}  // namespace hlc::apps
