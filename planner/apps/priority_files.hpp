#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "planner/apps/result_folder.hpp"
#include "planner/rollout/priority_trial.hpp"
#include "planner/scenario/scenario.hpp"

namespace hlc::apps {

/// One run of compare_priorities.
struct PriorityRun {
  std::size_t cars{};
  std::string strategy;
  std::size_t draw{};  ///< 0: the scenario's own
  rollout::PriorityTrial trial;
};

/// What the runs have in common.
struct PriorityPlan {
  std::vector<std::string> strategies;
  std::vector<std::size_t> cars;
  std::vector<std::size_t> draws;
};

/// Makes the folder, before anything is driven.
/// @throws std::invalid_argument naming --out if it cannot be written
void prepare_priority_folder(const std::filesystem::path& folder);

/// Writes what vehicle_sim/report makes the page of:
///
///     campaign.json  kind "priorities": origin, and the plan of the runs
///     runs.csv       a row per run: the values of PriorityTrial
///     steps.csv      a row per run and step: processor time of all vehicles, levels
///     gaps.csv       a row per run, step and component with a known JointGap: its costs and bound
///
/// @throws std::runtime_error naming the file if it cannot be written
void write_priority_files(const std::filesystem::path& folder, const EvaluationOrigin& origin,
                          const scenario::Scenario& scenario, const PriorityPlan& plan,
                          const std::vector<PriorityRun>& runs);

}  // namespace hlc::apps
