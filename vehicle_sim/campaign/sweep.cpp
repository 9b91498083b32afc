#include "vehicle_sim/campaign/sweep.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "planner/common/demand.hpp"
#include "planner/maneuver_design/automaton_builder.hpp"
#include "planner/scenario/named_subgraph.hpp"
#include "planner/scenario/starts.hpp"
#include "planner/search/search_options.hpp"
#include "vehicle_sim/campaign/exact_run.hpp"

namespace hlc::campaign {
namespace {

/// Only the driven subgraphs, and the part of the automaton that they need.
maneuver_design::AutomatonConfiguration narrowed(
    const SweepPlan& plan, maneuver_design::AutomatonConfiguration configuration) {
  // Places in the file are meaningless for values of the sweep.
  configuration.places = {};
  std::erase_if(configuration.subgraphs, [&](const automaton::SubgraphSpec& spec) {
    return std::ranges::find(plan.subgraphs, spec.name) == plan.subgraphs.end();
  });
  std::erase_if(configuration.criteria, [&](const maneuver_design::LabelledCriterion& criterion) {
    return std::ranges::none_of(configuration.subgraphs, [&](const automaton::SubgraphSpec& spec) {
      return maneuver_design::uses(spec, criterion.label);
    });
  });
  return configuration;
}

/// Changes the configuration; returns the changed values, one text for each different automaton.
std::string apply_to_automaton(const SweepPlan& plan, const SweepCombination& combination,
                               maneuver_design::AutomatonConfiguration& configuration) {
  std::string key;
  for (const SweepSetting& setting : sweep_settings()) {
    const SweepValue* value = value_of(plan, combination, setting.name);
    if (value == nullptr || !setting.on_automaton) continue;
    setting.on_automaton(*value, configuration);
    if (setting.name != kTrimsSetting) key += value->text + ' ';
  }
  return key;
}

std::uint64_t first_step_of(const SweepPlan& plan, const SweepCombination& combination) {
  const SweepValue* lap = value_of(plan, combination, kLapSetting);
  return lap != nullptr && lap->text == "flying" ? kFlyingStep : 0;
}

}  // namespace

Sweep::Sweep(SweepPlan plan) : plan_(std::move(plan)), combinations_(combinations_of(plan_)) {
  maneuver_design::AutomatonConfiguration whole =
      maneuver_design::read_automaton_configuration(plan_.automaton);
  offered_ = whole.subgraphs;
  trims_ = whole.trims;
  const maneuver_design::AutomatonConfiguration as_read = narrowed(plan_, std::move(whole));
  std::map<std::string, std::size_t> automaton_by_key;
  for (std::size_t c = 0; c < combinations_.size(); ++c) {
    maneuver_design::AutomatonConfiguration changed = as_read;
    const std::string key = apply_to_automaton(plan_, combinations_[c], changed);
    const auto [entry, is_new] = automaton_by_key.try_emplace(key, automata_.size());
    if (is_new) automata_.push_back({.configuration = std::move(changed)});
    automaton_of_.push_back(entry->second);
    const std::string profile = profile_of(combinations_[c]);
    for (std::size_t scenario = 0; scenario < plan_.scenarios.size(); ++scenario) {
      if (!scenarios_.contains({scenario, profile})) {
        scenarios_.emplace(std::pair{scenario, profile},
                           scenario::read_scenario({.file = plan_.scenarios[scenario],
                                                    .profile = profile,
                                                    .subgraph = plan_.subgraphs.front(),
                                                    .policy = policy::kNoPolicy,
                                                    .steps = plan_.steps}));
      }
      for (std::size_t subgraph = 0; subgraph < plan_.subgraphs.size(); ++subgraph) {
        for (std::size_t start = 0; start < plan_.starts; ++start) {
          runs_.push_back({c, scenario, subgraph, start});
        }
      }
    }
  }
  std::map<std::string, std::size_t> by_name;
  for (const auto& [key, scenario] : scenarios_) {
    const auto [same, is_new] = by_name.emplace(scenario.name, key.first);
    if (same->second == key.first) continue;
    throw std::invalid_argument(scenario.file.string() + ": name = " + scenario.name + " as in " +
                                plan_.scenarios[same->second].string() +
                                ", scenario names must be unique");
  }
  if (plan_.starts == 1) return;
  for (const auto& [key, scenario] : scenarios_) {
    static_cast<void>(scenario::with_random_starts(scenario, plan_.seed + 1));
  }
}

std::string Sweep::profile_of(const SweepCombination& combination) const {
  const SweepValue* profile = value_of(plan_, combination, kProfileSetting);
  return profile != nullptr ? profile->text : "default";
}

std::size_t Sweep::automaton_of(std::size_t run) const {
  return automaton_of_[runs_.at(run).combination];
}

std::vector<TrimId> Sweep::moving_trims() const {
  std::vector<TrimId> moving;
  for (std::size_t i = 0; i < trims_.size(); ++i) {
    if (!trims_[i].is_equilibrium()) moving.push_back(TrimId{i});
  }
  return moving;
}

void Sweep::build(std::size_t automaton) {
  DesignedAutomaton& designed = automata_.at(automaton);
  try {
    designed.automaton = maneuver_design::build_shared_automaton(designed.configuration);
  } catch (const std::exception& error) {
    designed.failure = error.what();
  }
}

scenario::Scenario Sweep::scenario_of(std::size_t run) const {
  const SweepRun& what = runs_.at(run);
  const SweepCombination& combination = combinations_[what.combination];
  const DesignedAutomaton& designed = automata_[automaton_of(run)];
  HLC_DEMAND(designed.automaton || !designed.failure.empty());
  if (!designed.automaton) throw std::runtime_error(designed.failure);
  scenario::Scenario scenario = scenarios_.at({what.scenario, profile_of(combination)});
  automaton::SubgraphSpec spec =
      *scenario::find_subgraph(designed.configuration.subgraphs, plan_.subgraphs[what.subgraph]);
  if (const SweepValue* trims = value_of(plan_, combination, kTrimsSetting)) {
    spec.trims = trims->trims;
  }
  scenario.subgraph = std::make_shared<automaton::Subgraph>(designed.automaton, spec);
  automaton::check_driving(*scenario.subgraph, scenario.horizon_steps);
  for (const SweepSetting& setting : sweep_settings()) {
    const SweepValue* value = value_of(plan_, combination, setting.name);
    if (value != nullptr && setting.on_scenario) setting.on_scenario(*value, scenario);
  }
  search::check_search_options(scenario.search);
  if (what.start > 0) scenario = scenario::with_random_starts(scenario, plan_.seed + what.start);
  if (scenario::overlapping_starts(scenario)) {
    throw std::invalid_argument(scenario.file.string() + ": cars overlap at the start");
  }
  return scenario;
}

std::set<std::filesystem::path> Sweep::files() const {
  std::set<std::filesystem::path> files{plan_.file};
  for (const auto& [key, scenario] : scenarios_) {
    for (const std::filesystem::path& file : scenario::files_of(scenario)) files.insert(file);
  }
  return files;
}

RunFigures Sweep::heading_of(std::size_t run) const {
  const SweepRun& what = runs_.at(run);
  const std::string profile = profile_of(combinations_[what.combination]);
  return {.scenario = scenarios_.at({what.scenario, profile}).name,
          .profile = profile,
          .subgraph = plan_.subgraphs[what.subgraph],
          .start = what.start};
}

SweepResult Sweep::drive(std::size_t run) const {
  SweepResult result{.figures = heading_of(run), .trace_sha256 = {}};
  const SweepCombination& combination = combinations_[runs_.at(run).combination];
  const std::uint64_t first_step = first_step_of(plan_, combination);
  const SweepValue* vehicle = value_of(plan_, combination, kVehicleSetting);
  const bool is_exact = vehicle != nullptr && vehicle->text == kExactVehicle;
  try {
    scenario::Scenario scenario = scenario_of(run);
    const DrivenRun done =
        is_exact ? drive_exactly(std::move(scenario)) : drive_run(std::move(scenario), {});
    const CampaignResult driven = result_of(done, std::nullopt, first_step);
    result.figures = with_figures(std::move(result.figures), driven);
    result.trace_sha256 = driven.summary.trace_sha256;
  } catch (const std::exception& error) {
    result.figures.failure = error.what();
  }
  return result;
}

}  // namespace hlc::campaign
