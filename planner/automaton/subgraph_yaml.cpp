#include "planner/automaton/subgraph_yaml.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "planner/automaton/trim_format.hpp"
#include "planner/common/yaml_text.hpp"

namespace hlc::automaton {
namespace {

template <class T>
bool contains(const std::vector<T>& list, const T& value) {
  return std::find(list.begin(), list.end(), value) != list.end();
}

TrimId as_trim(std::size_t number) { return TrimId{number - 1}; }

Allowed trim_numbers(const SubgraphContext& context) {
  return between(1.0, static_cast<double>(context.trims.size()));
}

std::vector<TrimId> read_trims(const Node& entry, const SubgraphContext& context) {
  std::vector<TrimId> result;
  if (entry.is_value("trims")) {
    (void)entry.required<std::string>("trims", one_of({"all"}));
    for (std::size_t i = 0; i < context.trims.size(); ++i) result.push_back(TrimId{i});
    return result;
  }
  for (const Node& one : entry.list("trims")) {
    const TrimId trim = as_trim(one.as<std::size_t>(trim_numbers(context)));
    if (contains(result, trim)) one.fail("unique");
    result.push_back(trim);
  }
  if (std::none_of(result.begin(), result.end(),
                   [&](TrimId id) { return context.trims[id.index].is_equilibrium(); })) {
    entry.fail("trims", "a list with a trim of speed 0");
  }
  return result;
}

std::vector<std::string> read_label_list(const Node& entry, const SubgraphContext& context) {
  std::vector<std::string> labels;
  for (const Node& one : entry.list("labels")) {
    labels.push_back(one.as<std::string>(one_of(context.labels)));
    if (std::count(labels.begin(), labels.end(), labels.back()) > 1) one.fail("unique");
  }
  if (labels.empty()) entry.fail("labels", "a list with at least one label");
  return labels;
}

std::vector<std::string> read_labels(const Node& entry, const SubgraphContext& context) {
  if (!entry.has("labels")) {
    return {entry.required<std::string>("label", one_of(context.labels))};
  }
  if (entry.has("label")) entry.fail("label", "given without `labels`");
  return read_label_list(entry, context);
}

TrimPair read_pair(const Node& entry, const SubgraphContext& context) {
  const auto from = entry.required<std::size_t>("from", trim_numbers(context));
  const auto to = entry.required<std::size_t>("to", trim_numbers(context));
  return {as_trim(from), as_trim(to)};
}

/// The rule's pairs among the declared trims.
std::vector<TrimPair> pairs_of(const SubgraphSpec& spec, const SubgraphContext& context) {
  return rule_edges(spec.rule, context.trims, spec.trims, context.vehicle, context.limits,
                    context.step_s);
}

void read_edge_labels(const Node& entry, const SubgraphContext& context, SubgraphSpec& spec) {
  const std::vector<TrimPair> pairs = pairs_of(spec, context);
  for (const Node& one : entry.optional_list("edges")) {
    const TrimPair pair = read_pair(one, context);
    if (pair.from == pair.to || !contains(pairs, pair)) {
      one.fail("to", "a trim that the rule connects with `from`");
    }
    if (std::any_of(spec.edges.begin(), spec.edges.end(),
                    [&](const EdgeLabels& other) { return other.edge == pair; })) {
      one.fail("unique");
    }
    spec.edges.push_back({pair, read_label_list(one, context)});
    one.check_no_unknown_keys();
  }
}

/// Checks an entry of `disabled_edges` between other trims. Edges out of enabled trims are those of
/// the subgraph; any other edge of the automaton may lead out of a disabled trim (see Subgraph).
void check_disabled(const Node& one, const DisabledEdges& disabled,
                    const std::vector<TrimPair>& pairs, const SubgraphContext& context,
                    const SubgraphSpec& spec) {
  const bool is_left_from =
      !contains(spec.trims, disabled.edge.from) ||
      (spec.max_speed_mps &&
       context.trims[disabled.edge.from.index].speed_mps > *spec.max_speed_mps);
  if (is_left_from) return;
  if (!contains(pairs, disabled.edge)) one.fail("to", "a trim that the rule connects with `from`");
  if (!disabled.label) return;
  const auto listed = std::ranges::find(spec.edges, disabled.edge, &EdgeLabels::edge);
  const auto& labels = listed == spec.edges.end() ? spec.labels : listed->labels;
  static_cast<void>(one.required<std::string>("label", one_of(labels)));
}

void read_off(const Node& entry, const SubgraphContext& context, SubgraphSpec& spec) {
  const std::vector<TrimPair> pairs = pairs_of(spec, context);
  for (const Node& one : entry.optional_list("disabled_edges")) {
    DisabledEdges disabled{read_pair(one, context), std::nullopt};
    if (one.has("label"))
      disabled.label = one.required<std::string>("label", one_of(context.labels));
    one.check_no_unknown_keys();
    if (disabled.edge.from == disabled.edge.to &&
        context.trims[disabled.edge.from.index].is_equilibrium()) {
      one.fail("to", "an edge other than standing, which must be possible");
    }
    if (disabled.edge.from == disabled.edge.to && disabled.label) {
      one.fail("label", "absent for a self-loop, which is the same for all labels");
    }
    if (disabled.edge.from != disabled.edge.to) check_disabled(one, disabled, pairs, context, spec);
    if (contains(spec.disabled_edges, disabled)) one.fail("unique");
    spec.disabled_edges.push_back(std::move(disabled));
  }
}

/// Fewest steps from `start` to every trim, along the pairs or against them.
std::vector<std::size_t> steps_from(const std::vector<TrimId>& starts,
                                    const std::vector<TrimPair>& pairs, bool against,
                                    std::size_t num_trims) {
  std::vector<std::size_t> steps(num_trims, Subgraph::kNever);
  for (const TrimId start : starts) steps[start.index] = 0;
  const auto shortens = [&](const TrimPair& pair) {
    const std::size_t near = steps[(against ? pair.to : pair.from).index];
    std::size_t& far = steps[(against ? pair.from : pair.to).index];
    if (near == Subgraph::kNever || near + 1 >= far) return false;
    far = near + 1;
    return true;
  };
  for (bool is_shorter = true; is_shorter;) {
    is_shorter = false;
    for (const TrimPair& pair : pairs) is_shorter |= shortens(pair);
  }
  return steps;
}

void check_connected(const Node& entry, const SubgraphContext& context, const SubgraphSpec& spec) {
  const auto is_too_fast = [&](TrimId trim) {
    return spec.max_speed_mps && context.trims[trim.index].speed_mps > *spec.max_speed_mps;
  };
  std::vector<TrimPair> pairs = pairs_of(spec, context);
  std::erase_if(pairs, [&](const TrimPair& pair) {
    return is_too_fast(pair.from) || is_too_fast(pair.to) || labels_of(spec, pair).empty();
  });
  std::vector<TrimId> standing;
  for (const TrimId trim : spec.trims) {
    if (context.trims[trim.index].is_equilibrium()) standing.push_back(trim);
  }
  const auto from_start = steps_from({standing.front()}, pairs, false, context.trims.size());
  const auto to_stand = steps_from(standing, pairs, true, context.trims.size());
  for (const TrimId trim : spec.trims) {
    if (is_too_fast(trim)) continue;
    if (from_start[trim.index] == Subgraph::kNever) {
      entry.fail("trims", fmt::format("connected trims: no edges lead from trim {} to trim {}",
                                      standing.front().index + 1, trim.index + 1));
    }
    if (to_stand[trim.index] > context.horizon_steps) {
      const std::string needed = to_stand[trim.index] == Subgraph::kNever
                                     ? "never reaches it"
                                     : fmt::format("needs {} steps", to_stand[trim.index]);
      entry.fail("trims", fmt::format("trims that reach a trim of speed 0 within the horizon of {} "
                                      "steps; trim {} {}",
                                      context.horizon_steps, trim.index + 1, needed));
    }
  }
}

SubgraphSpec read_subgraph(const Node& entry, const SubgraphContext& context) {
  SubgraphSpec spec;
  spec.name = entry.required<std::string>("name");
  if (spec.name.empty() || has_control_characters(spec.name)) {
    entry.fail("name", "one line of text, not empty");
  }
  spec.labels = read_labels(entry, context);
  spec.trims = read_trims(entry, context);
  const auto rule = entry.optional<std::string>("rule", "chain", one_of({"chain", "reachable"}));
  spec.rule = rule == "chain" ? EdgeRule::kChain : EdgeRule::kReachable;
  if (entry.has("max_speed_mps")) {
    spec.max_speed_mps = entry.required<double>("max_speed_mps", at_least(0.0));
  }
  read_edge_labels(entry, context, spec);
  read_off(entry, context, spec);
  entry.check_no_unknown_keys();
  check_connected(entry, context, spec);
  return spec;
}

template <class T, class Print>
std::string list_of(const std::vector<T>& values, Print print) {
  std::vector<std::string> texts;
  for (const T& value : values) texts.push_back(print(value));
  return fmt::format("[{}]", fmt::join(texts, ", "));
}

std::string ends(const TrimPair& edge) {
  return fmt::format("from: {}, to: {}", edge.from, edge.to);
}

}  // namespace

std::vector<SubgraphSpec> read_subgraphs(const Node& file, const SubgraphContext& context) {
  std::vector<SubgraphSpec> subgraphs;
  for (const Node& entry : file.list("subgraphs")) {
    SubgraphSpec spec = read_subgraph(entry, context);
    if (std::any_of(subgraphs.begin(), subgraphs.end(),
                    [&spec](const SubgraphSpec& other) { return other.name == spec.name; })) {
      entry.fail("name", "a name that no other subgraph has");
    }
    subgraphs.push_back(std::move(spec));
  }
  if (subgraphs.empty()) file.fail("subgraphs", "a list with at least one subgraph");
  return subgraphs;
}

std::string to_yaml(const SubgraphSpec& spec) {
  std::string text = fmt::format("{{name: {}, labels: {}, trims: [{}]", quoted_yaml(spec.name),
                                 list_of(spec.labels, quoted_yaml), fmt::join(spec.trims, ", "));
  text += spec.rule == EdgeRule::kChain ? ", rule: chain" : ", rule: reachable";
  if (spec.max_speed_mps) text += ", max_speed_mps: " + shortest_text(*spec.max_speed_mps);
  if (!spec.disabled_edges.empty()) {
    text += ", disabled_edges: " + list_of(spec.disabled_edges, [](const DisabledEdges& disabled) {
              return fmt::format("{{{}{}}}", ends(disabled.edge),
                                 disabled.label ? ", label: " + quoted_yaml(*disabled.label) : "");
            });
  }
  if (!spec.edges.empty()) {
    text += ", edges: " + list_of(spec.edges, [](const EdgeLabels& one) {
              return fmt::format("{{{}, labels: {}}}", ends(one.edge),
                                 list_of(one.labels, quoted_yaml));
            });
  }
  return text + "}";
}

}  // namespace hlc::automaton
