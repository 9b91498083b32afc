#pragma once

#include <filesystem>
#include <string>

#include "hlc_bridge/result/run_record.hpp"

namespace hlc::record {

/// run.json: how the run went, written by the lab control.
[[nodiscard]] std::string facts_json(const result::RunFacts& facts);

/// @throws std::runtime_error naming the file and what is wrong
[[nodiscard]] result::RunFacts read_facts(const std::filesystem::path& file);

}  // namespace hlc::record
