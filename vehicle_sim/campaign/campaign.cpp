#include "vehicle_sim/campaign/campaign.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "hlc_bridge/messages/exit_codes.hpp"
#include "hlc_bridge/result/driving_fault.hpp"
#include "hlc_bridge/result/run_description.hpp"
#include "planner/common/yaml_text.hpp"
#include "planner/scenario/starts.hpp"

namespace hlc::campaign {
namespace {

std::string key_of(const CampaignRun& run) {
  return run.scenario.string() + '\n' + run.profile + '\n' + run.subgraph.value_or("") + '\n' +
         run.policy.value_or("");
}

/// The scenario as driven without a policy.
CampaignRun fixed(CampaignRun run) {
  run.policy.reset();
  return run;
}

/// The scenario, switched by one of its policies.
scenario::Scenario with_policy(scenario::Scenario scenario, const std::string& policy) {
  const auto settings = scenario.policies.find(policy);
  if (settings == scenario.policies.end()) {
    std::vector<std::string> known;
    for (const auto& [name, other] : scenario.policies) known.push_back(one_line(name));
    if (known.empty()) known.emplace_back("it has none");
    throw std::invalid_argument(fmt::format(
        "--policies = {}, must be one of {}: {}{}", one_line(policy), scenario.file.string(),
        fmt::join(known, ", "),
        policy == policy::kNoPolicy ? " (fixed subgraphs, --subgraphs, are driven without one)"
                                    : ""));
  }
  scenario.policy = policy;
  scenario.reconfiguration = settings->second;
  return scenario;
}

}  // namespace

std::vector<CampaignRun> runs_of(const CampaignPlan& plan) {
  struct PlannedOn {
    std::optional<std::string> subgraph;
    std::optional<std::string> policy;
  };
  std::vector<PlannedOn> choices;
  for (const std::string& subgraph : plan.subgraphs) choices.push_back({.subgraph = subgraph});
  if (choices.empty()) choices.emplace_back();
  for (const std::string& policy : plan.policies) choices.push_back({.policy = policy});
  std::vector<CampaignRun> runs;
  for (const auto& scenario : plan.scenarios) {
    for (const auto& profile : plan.profiles) {
      for (const PlannedOn& on : choices) {
        for (std::size_t start = 0; start < plan.starts; ++start) {
          runs.push_back({scenario, profile, on.subgraph, on.policy, start});
        }
      }
    }
  }
  return runs;
}

Campaign::Campaign(CampaignPlan plan) : plan_(std::move(plan)), runs_(runs_of(plan_)) {
  std::map<std::string, std::filesystem::path> by_name;
  for (const CampaignRun& run : runs_) {
    for (const CampaignRun& one : {fixed(run), run}) {
      if (!scenarios_.contains(key_of(one))) scenarios_.emplace(key_of(one), read(one));
    }
    const std::string& name = scenario_of(run).name;
    const auto [same, is_new] = by_name.emplace(name, run.scenario);
    if (same->second != run.scenario) {
      throw std::invalid_argument(run.scenario.string() + ": name = " + name + " as in " +
                                  same->second.string() + ", scenario names must be unique");
    }
    if (run.start > 0) {
      scenario::check_random_starts(scenario_of(run), plan_.seed + run.start);
    }
  }
}

scenario::Scenario Campaign::read(const CampaignRun& run) const {
  if (run.policy) return with_policy(scenario_of(fixed(run)), *run.policy);
  return scenario::read_scenario({.file = run.scenario,
                                  .profile = run.profile,
                                  .subgraph = run.subgraph,
                                  .policy = policy::kNoPolicy,
                                  .map_file = plan_.map_file,
                                  .steps = plan_.steps,
                                  .cars = plan_.cars,
                                  .routes = plan_.routes});
}

const scenario::Scenario& Campaign::scenario_of(const CampaignRun& run) const {
  return scenarios_.at(key_of(run));
}

std::set<std::filesystem::path> Campaign::files() const {
  std::set<std::filesystem::path> files;
  for (const auto& [key, scenario] : scenarios_) {
    for (const std::filesystem::path& file : scenario::files_of(scenario)) files.insert(file);
  }
  return files;
}

RunFigures Campaign::heading_of(std::size_t i) const {
  const CampaignRun& run = runs_.at(i);
  const scenario::Scenario& scenario = scenario_of(run);
  return {.scenario = scenario.name,
          .profile = scenario.profile.name,
          .subgraph = scenario.subgraph->spec().name,
          .policy = run.policy.value_or(policy::kNoPolicy),
          .start = run.start};
}

DrivenRun Campaign::drive(std::size_t i, const closed_loop::Clocks& clocks) const {
  const CampaignRun& run = runs_.at(i);
  const scenario::Scenario& as_read = scenario_of(run);
  return drive_run(
      run.start == 0 ? as_read : scenario::with_random_starts(as_read, plan_.seed + run.start),
      {.noise_seed = plan_.noise_seed, .clocks = clocks});
}

CampaignResult Campaign::result_of(const DrivenRun& run) const {
  std::vector<policy::SpeedZone> zones;
  for (const std::string& policy : plan_.policies) {
    for (const policy::SpeedZone& zone : run.scenario.policies.at(policy).zones) {
      if (std::ranges::find(zones, zone) == zones.end()) zones.push_back(zone);
    }
  }
  return campaign::result_of(run, plan_.noise_seed, 0, zones);
}

DrivenRun drive_run(scenario::Scenario scenario, closed_loop::ExperimentOptions options) {
  options.steps = scenario.steps;
  DrivenRun driven{.scenario = std::move(scenario), .experiment = {}};
  driven.experiment = closed_loop::drive_experiment(driven.scenario, options);
  return driven;
}

CampaignResult result_of(const DrivenRun& run, std::optional<std::uint64_t> noise_seed,
                         std::uint64_t first_step, std::span<const policy::SpeedZone> zones) {
  const closed_loop::Experiment& experiment = run.experiment;
  result::RunFacts facts = experiment.facts;
  if (!is_driven_to_end(facts.exit_code)) throw std::runtime_error(facts.reason);
  std::vector<result::StepRecord> rows =
      result::step_records(experiment.reports, experiment.drives, facts);
  std::erase_if(rows,
                [first_step](const result::StepRecord& row) { return row.step < first_step; });
  // Encounters are searched from the first step of the facts on.
  facts.first_step = facts.first_step.value() + first_step;
  facts.steps -= std::min(facts.steps, first_step);
  CampaignResult result{
      .summary = result::summarize(result::describe(run.scenario, noise_seed), facts, rows,
                                   experiment.drives),
      .fault = {},
      .wall = experiment.wall,
      .steps_s = experiment.steps_s,
      .costs = driven_costs(rows, experiment.drives, facts, run.scenario.subgraph->automaton()),
      .excess = zone_excess(zones, experiment.drives, facts),
      .use = subgraph_use(rows)};
  result.fault = result::danger_of(result.summary);
  return result;
}

}  // namespace hlc::campaign
