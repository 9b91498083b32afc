#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "hlc_bridge/record/run_folder.hpp"
#include "vehicle_sim/closed_loop/experiment.hpp"

namespace hlc::apps {

/// What the run was driven with, for the same drive within one process; its forks included.
/// @throws std::invalid_argument with one line: a run in real time (it depends on when messages
/// arrived), or run.json, flags.yaml or forks.yaml with a bad value
[[nodiscard]] closed_loop::ExperimentOptions options_of_run(const record::RunFolder& run);

/// @param rows  of the run driven again
/// @throws std::invalid_argument with one line if it differs from what is recorded before this
/// step: no fork of it would be a fork of what was driven
void check_same_until(std::uint64_t step, const record::RunFolder& run,
                      std::span<const result::StepRecord> rows);

/// The run folder of a fork.
/// @param out  as given; empty: beside the run, named after it and the step
/// @throws std::invalid_argument if it exists and is not empty, or cannot be created
[[nodiscard]] std::filesystem::path fork_folder(const record::RunFolder& run, std::uint64_t from,
                                                const std::filesystem::path& out);

/// Writes it: the records, and the configuration of the run that it comes from with one more
/// fork (record::kept_forks).
/// @throws std::runtime_error naming what cannot be written
void write_fork(const std::filesystem::path& folder, const record::RunFolder& run,
                std::uint64_t from, const std::vector<std::string>& set,
                const closed_loop::Experiment& experiment);

}  // namespace hlc::apps
