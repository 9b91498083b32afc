#include "planner/automaton/requested_subgraph.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>
#include <utility>

#include "planner/automaton/trim_format.hpp"
#include "planner/common/yaml_text.hpp"

namespace hlc::automaton {
namespace {

[[noreturn]] void refuse(const std::string& reason) { throw std::invalid_argument(reason); }

template <class Items>
std::string listed(const Items& items) {
  return fmt::format("{}", fmt::join(items, ", "));
}

bool contains(const std::vector<TrimId>& trims, TrimId trim) {
  return std::ranges::find(trims, trim) != trims.end();
}

void check_trim(TrimId trim, const UniversalAutomaton& automaton) {
  if (trim.index >= automaton.trims.size()) {
    refuse(fmt::format("trim {}, must be in 1 ... {}", trim, automaton.trims.size()));
  }
}

void change_labels(SubgraphSpec& spec, const UniversalAutomaton& automaton,
                   const SubgraphRequest& request) {
  const std::vector<std::string>& labels = request.labels;
  if (!request.weights.empty()) {
    if (!labels.empty())
      refuse("labels " + listed(labels) + " and weights, must be only one of both");
    spec.labels = {label_of(request.weights)};
    spec.edges.clear();
    return;
  }
  if (labels.empty()) return;
  std::set<std::string> known;
  for (const Maneuver& maneuver : automaton.maneuvers) {
    if (maneuver.from != maneuver.to) known.insert(maneuver.label);
  }
  for (const std::string& label : labels) {
    if (!known.contains(label)) {
      refuse("label '" + one_line(label) + "', must be one of " + listed(known) +
             " in the automaton");
    }
  }
  spec.labels = labels;
  spec.edges.clear();
}

/// Keeps the order of the declaration, which the chain rule depends on: a new trim comes before the
/// first one with a larger number.
void enable(SubgraphSpec& spec, const UniversalAutomaton& automaton, TrimId trim) {
  check_trim(trim, automaton);
  if (contains(spec.trims, trim))
    refuse(fmt::format("trim {}: must be disabled, is enabled", trim));
  spec.trims.insert(std::ranges::find_if(spec.trims, [trim](TrimId other) { return other > trim; }),
                    trim);
}

void disable(SubgraphSpec& spec, const UniversalAutomaton& automaton, TrimId trim) {
  check_trim(trim, automaton);
  if (!contains(spec.trims, trim))
    refuse(fmt::format("trim {}: must be enabled, is disabled", trim));
  std::erase(spec.trims, trim);
  const auto names_it = [trim](const auto& one) {
    return one.edge.from == trim || one.edge.to == trim;
  };
  std::erase_if(spec.edges, names_it);
}

void enable(SubgraphSpec& spec, const UniversalAutomaton& automaton, const TrimPair& edge) {
  check_trim(edge.from, automaton);
  check_trim(edge.to, automaton);
  if (std::erase_if(spec.disabled_edges,
                    [&](const DisabledEdges& disabled) { return disabled.edge == edge; }) == 0) {
    refuse(fmt::format("edge {}: must be disabled in the scenario's subgraph", edge));
  }
}

void disable(SubgraphSpec& spec, const UniversalAutomaton& automaton, const TrimPair& edge) {
  check_trim(edge.from, automaton);
  check_trim(edge.to, automaton);
  spec.disabled_edges.push_back({edge, std::nullopt});
}

void limit_speed(SubgraphSpec& spec, const UniversalAutomaton& automaton, double max_speed_mps) {
  double slowest_mps = INFINITY;
  for (const TrimId trim : spec.trims) {
    const double speed_mps = automaton.trims[trim.index].speed_mps;
    if (speed_mps > 0.0) slowest_mps = std::min(slowest_mps, speed_mps);
  }
  if (!(max_speed_mps >= slowest_mps) || !std::isfinite(max_speed_mps)) {
    refuse("speed limit " + shortest_text(max_speed_mps) +
           " m/s, must be >= " + shortest_text(slowest_mps) + ", the slowest enabled moving trim");
  }
  spec.max_speed_mps = max_speed_mps;
}

std::string name_of(const std::string& base, const SubgraphRequest& request) {
  std::string name = base;
  const auto add = [&name](const std::string& what) { name += ", " + what; };
  if (!request.labels.empty()) {
    add((request.labels.size() == 1 ? "label " : "labels ") + listed(request.labels));
  }
  if (!request.weights.empty()) add("weights " + label_of(request.weights));
  if (request.max_speed_mps) add("at most " + shortest_text(*request.max_speed_mps) + " m/s");
  if (!request.enable_trims.empty()) add("with trims " + listed(request.enable_trims));
  if (!request.disable_trims.empty()) add("without trims " + listed(request.disable_trims));
  if (!request.enable_edges.empty()) add("with edges " + listed(request.enable_edges));
  if (!request.disable_edges.empty()) add("without edges " + listed(request.disable_edges));
  return name;
}

}  // namespace

std::string label_of(std::vector<CriterionWeight> weights) {
  std::ranges::stable_sort(weights, {}, &CriterionWeight::criterion);
  std::vector<std::string> texts;
  for (const CriterionWeight& one : weights) {
    if (one.weight != 0.0) texts.push_back(one.criterion + " " + shortest_text(one.weight));
  }
  return fmt::format("{}", fmt::join(texts, " "));
}

SubgraphSpec requested_spec(const Subgraph& base, const SubgraphRequest& request) {
  const UniversalAutomaton& automaton = base.automaton();
  SubgraphSpec spec = base.spec();
  spec.name = name_of(spec.name, request);
  change_labels(spec, automaton, request);
  for (const TrimId trim : request.enable_trims) enable(spec, automaton, trim);
  for (const TrimId trim : request.disable_trims) disable(spec, automaton, trim);
  for (const TrimPair& edge : request.enable_edges) enable(spec, automaton, edge);
  for (const TrimPair& edge : request.disable_edges) disable(spec, automaton, edge);
  if (request.max_speed_mps) limit_speed(spec, automaton, *request.max_speed_mps);
  return spec;
}

std::shared_ptr<const Subgraph> requested_subgraph(
    const Subgraph& base, const SubgraphRequest& request, std::size_t horizon_steps,
    std::shared_ptr<const UniversalAutomaton> automaton) {
  if (!automaton) automaton = base.shared_automaton();
  auto subgraph =
      std::make_shared<const Subgraph>(std::move(automaton), requested_spec(base, request));
  check_driving(*subgraph, horizon_steps);
  return subgraph;
}

}  // namespace hlc::automaton
