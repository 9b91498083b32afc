#pragma once

#include <filesystem>
#include <string>

#include "hlc_bridge/record/run_folder.hpp"
#include "hlc_bridge/result/run_summary.hpp"
#include "hlc_bridge/view/page_messages.hpp"

/// A run folder as pages and viewers show it.
namespace hlc::apps {

/// What a run that was driven gets from its result: the exit code, and why it is not 0.
struct Verdict {
  int exit_code{};
  std::string fault;
};
[[nodiscard]] Verdict verdict_on(const result::RunSummary& summary);

[[nodiscard]] std::filesystem::path page_file(const std::filesystem::path& run);

/// @param fault  of its verdict; faults of its records are added
/// @throws std::runtime_error, std::invalid_argument with one line that names the file: its map,
/// its logs or its explanations
[[nodiscard]] view::FinishedRun finished_run(record::RunFolder read, std::string fault);

/// Writes the page file, with the run's verdict.
/// @throws as finished_run; std::runtime_error naming the file if it cannot be written
void write_page(record::RunFolder read);

}  // namespace hlc::apps
