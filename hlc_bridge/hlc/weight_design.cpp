#include "hlc_bridge/hlc/weight_design.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "planner/automaton/lab_check.hpp"
#include "planner/automaton/requested_subgraph.hpp"
#include "planner/automaton/vehicle_yaml.hpp"
#include "planner/common/yaml_text.hpp"
#include "planner/maneuver_design/automaton_builder.hpp"
#include "planner/maneuver_design/criteria.hpp"

namespace hlc::high_level_controller {
namespace {

constexpr double kSpeedRounding_mps = 1e-6;  // of the states of maneuvers, as in Subgraph

[[noreturn]] void refuse_weights(const std::string& reason) {
  throw std::invalid_argument("weights: " + reason);
}

void check_weights(const std::vector<CriterionWeight>& weights) {
  const std::vector<std::string> known = maneuver_design::criterion_names();
  double sum = 0.0;
  for (const auto& [criterion, weight] : weights) {
    if (std::ranges::find(known, criterion) == known.end()) {
      std::string names;
      for (const std::string& name : known) names += (names.empty() ? "" : ", ") + name;
      refuse_weights("criterion '" + one_line(criterion) + "', must be one of " + names);
    }
    if (std::ranges::count(weights, criterion, &CriterionWeight::criterion) > 1) {
      refuse_weights(criterion + " is listed twice");
    }
    if (!(weight >= 0.0) || !std::isfinite(weight)) {
      refuse_weights(criterion + " = " + shortest_text(weight) + ", must be >= 0");
    }
    sum += weight;
  }
  if (sum <= 0.0) refuse_weights("all 0, at least one must be > 0");
}

/// The configuration may have been edited since the automaton was built.
bool describes(const maneuver_design::AutomatonConfiguration& configuration,
               const automaton::UniversalAutomaton& automaton) {
  return configuration.trims == automaton.trims && configuration.step_s == automaton.step_s &&
         automaton::to_yaml(configuration.limits) == automaton::to_yaml(automaton.limits) &&
         automaton::to_yaml(configuration.vehicle, configuration.identified) ==
             automaton::to_yaml(automaton.vehicle, automaton.identified);
}

}  // namespace

WeightDesign::WeightDesign(std::shared_ptr<const automaton::UniversalAutomaton> automaton,
                           Source source, std::optional<vehicle::LabLimits> lab)
    : automaton_(std::move(automaton)),
      source_(std::move(source)),
      lab_(lab),
      top_speed_mps_(automaton::top_speed_mps(*automaton_)) {}

const maneuver_design::AutomatonConfiguration& WeightDesign::configuration() {
  if (configuration_) return *configuration_;
  if (!source_) refuse_weights("configuration of the automaton unknown");
  maneuver_design::AutomatonConfiguration read = source_();
  if (!describes(read, *automaton_)) {
    refuse_weights(read.source + " differs from the automaton in use");
  }
  return configuration_.emplace(std::move(read));
}

std::shared_ptr<const automaton::UniversalAutomaton> WeightDesign::known(
    const std::string& label) const {
  for (const auto& [kept_label, automaton] : kept_) {
    if (kept_label == label) return automaton;
  }
  return automaton_;
}

void WeightDesign::keep(const std::string& label,
                        std::shared_ptr<const automaton::UniversalAutomaton> automaton) {
  std::erase_if(kept_, [&label](const auto& kept) { return kept.first == label; });
  kept_.emplace_front(label, std::move(automaton));
  if (kept_.size() > kMaxKept) kept_.pop_back();
}

std::shared_ptr<const automaton::UniversalAutomaton> WeightDesign::automaton_for(
    const automaton::SubgraphSpec& spec, const std::vector<CriterionWeight>& weights,
    const std::stop_token& stop) {
  check_weights(weights);
  const std::string label = automaton::label_of(weights);
  maneuver_design::AutomatonConfiguration wanted = configuration();
  wanted.criteria = {{.label = label, .weights = weights}};
  wanted.subgraphs = {spec};
  wanted.edges = maneuver_design::EdgeChoice::kSubgraphs;
  wanted.places = {};  // of keys that did not ask for this
  wanted.limits.speed_max_mps = std::min(wanted.limits.speed_max_mps, top_speed_mps_);

  std::shared_ptr<const automaton::UniversalAutomaton> automaton = known(label);
  std::vector<maneuver_design::DesignTask> tasks = maneuver_design::design_tasks(wanted);
  std::erase_if(tasks, [&](const maneuver_design::DesignTask& task) {
    const automaton::Maneuver* const held = automaton->find(task.edge.from, task.edge.to, label);
    return held != nullptr && held->label == label;
  });
  if (!tasks.empty()) {
    std::vector<automaton::Maneuver> designed = maneuver_design::design(wanted, tasks, [&stop] {
      if (stop.stop_requested()) refuse_weights("the controller is stopping");
    });
    auto larger = std::make_shared<automaton::UniversalAutomaton>(*automaton);
    std::ranges::move(designed, std::back_inserter(larger->maneuvers));
    automaton = std::move(larger);
  }
  keep(label, automaton);
  return automaton;
}

void WeightDesign::check(const automaton::Subgraph& subgraph) const {
  for (const TrimId from : subgraph.start_trims()) {
    for (const automaton::Edge& edge : subgraph.successors(from)) {
      const double speed_mps = automaton::top_speed_mps(*edge.maneuver);
      if (speed_mps <= top_speed_mps_ + kSpeedRounding_mps) continue;
      throw std::invalid_argument("maneuver " + std::to_string(from.index + 1) + " -> " +
                                  std::to_string(edge.to.index + 1) + " (" + edge.maneuver->label +
                                  ") reaches " + shortest_text(speed_mps) +
                                  " m/s, must be <= " + shortest_text(top_speed_mps_) +
                                  ", the most that the scenario's automaton holds");
    }
  }
  if (!lab_) return;
  if (const std::string fault = automaton::validate_for_lab(subgraph, *lab_); !fault.empty()) {
    throw std::invalid_argument(fault + " by the lab");
  }
}

}  // namespace hlc::high_level_controller
