#pragma once

#include <filesystem>
#include <vector>

#include "vehicle_sim/apps/run_log.hpp"

namespace hlc::apps {

/// Puts the rows of a campaign's shards together (`evaluate --shard`).
/// @param files  each a runs.jsonl, in any order
/// @return the rows of the whole campaign, as if one call had driven it
/// @throws std::invalid_argument with one line that names the file and what is allowed, for a file
/// that is no runs.jsonl of a campaign, rows of another format or another campaign than those of
/// the first file (choices, input files, program), a damaged row, a run in two files, or a run
/// that is in none
[[nodiscard]] RunRows merge_rows(const std::vector<std::filesystem::path>& files);

}  // namespace hlc::apps
