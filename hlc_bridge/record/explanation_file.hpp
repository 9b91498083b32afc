#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "hlc_bridge/result/explanation.hpp"

namespace hlc::record {

/// explanations.csv of a run folder: columns step (from 0), vehicle, text; a text has several lines
/// within quotes.
[[nodiscard]] std::filesystem::path explanations_file(const std::filesystem::path& run);

[[nodiscard]] std::string explanations_csv(std::span<const result::Explanation> explanations);

/// Those of the folder; none if it has no such file.
/// @param rows  of its run
/// @throws std::runtime_error naming file, line, column, value and bound: also for a step that is
/// not one of steps_to_explain(), as in the file of another run
[[nodiscard]] std::vector<result::Explanation> read_explanations(
    const std::filesystem::path& run, std::span<const result::StepRecord> rows);

/// searches/vehicle_<id>_step_<k>.html of a run folder, k from 0: what was searched.
[[nodiscard]] std::filesystem::path search_page_file(const std::filesystem::path& run,
                                                     VehicleId vehicle, std::uint64_t step);

/// Those of the folder.
/// @param rows  of its run
/// @throws std::runtime_error naming a file that cannot be read
[[nodiscard]] std::vector<result::SearchPage> read_search_pages(
    const std::filesystem::path& run, std::span<const result::StepRecord> rows);

}  // namespace hlc::record
