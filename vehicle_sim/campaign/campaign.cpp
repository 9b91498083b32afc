#include "vehicle_sim/campaign/campaign.hpp"

#include <stdexcept>
#include <utility>

#include "hlc_bridge/core/run_description.hpp"
#include "planner/scenario/starts.hpp"

namespace hlc {
namespace {

std::string key_of(const CampaignRun& run) {
  return run.scenario.string() + '\n' + run.profile + '\n' + run.subgraph.value_or("");
}

std::string fault_of(const RunSummary& summary) {
  if (summary.collisions > 0) {
    return "vehicles touched each other " + std::to_string(summary.collisions) + " times";
  }
  for (const VehicleSummary& vehicle : summary.vehicles) {
    if (vehicle.astray_steps == 0) continue;
    return "vehicle " + std::to_string(vehicle.id.value) +
           " was outside the areas that it had told the others in " +
           std::to_string(vehicle.astray_steps) + " steps";
  }
  return "";
}

}  // namespace

std::vector<CampaignRun> runs_of(const CampaignPlan& plan) {
  std::vector<std::optional<std::string>> subgraphs(plan.subgraphs.begin(), plan.subgraphs.end());
  if (subgraphs.empty()) subgraphs.emplace_back(std::nullopt);
  std::vector<CampaignRun> runs;
  for (const auto& scenario : plan.scenarios) {
    for (const auto& profile : plan.profiles) {
      for (const auto& subgraph : subgraphs) {
        for (std::size_t start = 0; start < plan.starts; ++start) {
          runs.push_back({scenario, profile, subgraph, start});
        }
      }
    }
  }
  return runs;
}

Campaign::Campaign(CampaignPlan plan) : plan_(std::move(plan)), runs_(runs_of(plan_)) {
  for (const CampaignRun& run : runs_) {
    if (!scenarios_.contains(key_of(run))) {
      scenarios_.emplace(key_of(run), read_scenario({.file = run.scenario,
                                                     .profile = run.profile,
                                                     .subgraph = run.subgraph,
                                                     .steps = plan_.steps}));
    }
    if (run.start > 0) {
      static_cast<void>(with_random_starts(scenario_of(run), plan_.seed + run.start));
    }
  }
}

const Scenario& Campaign::scenario_of(const CampaignRun& run) const {
  return scenarios_.at(key_of(run));
}

DrivenRun Campaign::drive(std::size_t i, const std::function<Nanoseconds()>& wall_clock) const {
  const CampaignRun& run = runs_.at(i);
  const Scenario& as_read = scenario_of(run);
  return drive_run(run.start == 0 ? as_read : with_random_starts(as_read, plan_.seed + run.start),
                   {.noise_seed = plan_.noise_seed, .wall_clock = wall_clock});
}

CampaignResult Campaign::result_of(const DrivenRun& run) const {
  return hlc::result_of(run, plan_.noise_seed);
}

DrivenRun drive_run(Scenario scenario, ExperimentOptions options) {
  options.steps = scenario.steps;
  DrivenRun driven{.scenario = std::move(scenario), .experiment = {}};
  driven.experiment = drive_experiment(driven.scenario, options);
  return driven;
}

CampaignResult result_of(const DrivenRun& run, std::optional<std::uint64_t> noise_seed,
                         std::uint64_t first_step) {
  const Experiment& experiment = run.experiment;
  if (experiment.facts.exit_code != 0) throw std::runtime_error(experiment.facts.reason);
  std::vector<StepRecord> rows =
      step_records(experiment.reports, experiment.drives, experiment.facts);
  std::erase_if(rows, [first_step](const StepRecord& row) { return row.step < first_step; });
  CampaignResult result{.summary = summarize(describe(run.scenario, noise_seed), experiment.facts,
                                             rows, experiment.drives),
                        .fault = {},
                        .wall = experiment.wall};
  result.fault = fault_of(result.summary);
  return result;
}

}  // namespace hlc
