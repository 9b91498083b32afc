#include "vehicle_sim/campaign/sweep_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <random>
#include <set>

#include "planner/automaton/automaton_file.hpp"
#include "planner/common/yaml_text.hpp"
#include "planner/scenario/named_subgraph.hpp"

namespace hlc::campaign {
namespace {

constexpr char kSubsets[] = "subsets";
constexpr std::size_t kMaxSubsetTrims = 16;
constexpr double kMaxRuns = 1e7;

std::filesystem::path beside(const std::filesystem::path& file, const std::string& path) {
  return (file.parent_path() / path).lexically_normal();
}

/// The choice of trims, whatever its order in the file, with every trim of speed 0.
SweepValue trims_value(const std::set<TrimId>& chosen, const std::vector<automaton::Trim>& trims) {
  SweepValue value;
  for (std::size_t i = 0; i < trims.size(); ++i) {
    if (!trims[i].is_equilibrium() && !chosen.contains(TrimId{i})) continue;
    value.trims.push_back(TrimId{i});
    value.text += fmt::format("{}{}", value.text.empty() ? "" : " ", i + 1);
  }
  return value;
}

std::vector<SweepValue> all_subsets(const Node& settings,
                                    const std::vector<automaton::Trim>& trims) {
  std::vector<TrimId> moving;
  for (std::size_t i = 0; i < trims.size(); ++i) {
    if (!trims[i].is_equilibrium()) moving.push_back(TrimId{i});
  }
  if (moving.empty() || moving.size() > kMaxSubsetTrims) {
    settings.fail(
        kTrimsSetting,
        fmt::format("lists of trims; all subsets only of 1 ... {} moving trims, not of {}",
                    kMaxSubsetTrims, moving.size()));
  }
  std::vector<SweepValue> values;
  for (std::size_t bits = 1; bits < (std::size_t{1} << moving.size()); ++bits) {
    std::set<TrimId> chosen;
    for (std::size_t i = 0; i < moving.size(); ++i) {
      if ((bits >> i & 1U) != 0U) chosen.insert(moving[i]);
    }
    values.push_back(trims_value(chosen, trims));
  }
  return values;
}

SweepValue read_trims(const Node& entry, const std::vector<automaton::Trim>& trims) {
  if (!entry.is_list()) entry.fail("a list of trims' numbers");
  std::set<TrimId> chosen;
  for (const Node& one : entry.entries()) {
    const TrimId trim{one.as<std::size_t>(between(1.0, static_cast<double>(trims.size()))) - 1};
    if (!chosen.insert(trim).second) one.fail("unique");
  }
  SweepValue value = trims_value(chosen, trims);
  if (std::ranges::all_of(chosen, [&](TrimId id) { return trims[id.index].is_equilibrium(); })) {
    entry.fail("a list with a trim of speed > 0");
  }
  return value;
}

SweepValue read_value(const Node& entry, const SweepSetting& setting,
                      const std::vector<automaton::Trim>& trims) {
  if (setting.name == kTrimsSetting) return read_trims(entry, trims);
  if (!setting.is_number) return {.text = entry.as<std::string>(setting.allowed)};
  const double number = entry.as<double>(setting.allowed);
  return {.text = shortest_text(number), .number = number};
}

std::vector<SweepAxis> read_axes(const Node& settings, const std::vector<automaton::Trim>& trims) {
  std::vector<SweepAxis> axes;
  for (const SweepSetting& setting : sweep_settings()) {
    if (!settings.has(setting.name)) continue;
    SweepAxis axis{.setting = setting.name, .values = {}};
    if (setting.name == kTrimsSetting && settings.is_value(setting.name)) {
      static_cast<void>(settings.required<std::string>(setting.name, one_of({kSubsets})));
      axis.values = all_subsets(settings, trims);
    } else {
      for (const Node& entry : settings.list(setting.name)) {
        SweepValue value = read_value(entry, setting, trims);
        const auto is_same = [&](const SweepValue& one) { return one.text == value.text; };
        if (std::ranges::any_of(axis.values, is_same)) entry.fail("unique");
        axis.values.push_back(std::move(value));
      }
      if (axis.values.empty()) settings.fail(setting.name, "a list with at least one value");
    }
    axes.push_back(std::move(axis));
  }
  settings.check_no_unknown_keys();
  return axes;
}

/// The scenarios, and the automaton that they share.
void read_scenarios(const Node& node, SweepPlan& plan) {
  for (const Node& entry : node.list("scenarios")) {
    const std::filesystem::path scenario = beside(plan.file, entry.as<std::string>());
    if (!std::filesystem::is_regular_file(scenario)) entry.fail("a scenario's file");
    // Reports identify scenarios by their names.
    if (std::ranges::any_of(plan.scenarios, [&](const std::filesystem::path& one) {
          return one.stem() == scenario.stem();
        })) {
      entry.fail("unique by name");
    }
    const Node in_scenario = Node::read_yaml(scenario);
    const auto automaton = beside(scenario, in_scenario.required<std::string>("automaton"));
    if (!plan.scenarios.empty() && automaton != plan.automaton) {
      entry.fail("a scenario on the same automaton, " + plan.automaton.string());
    }
    if (automaton::is_automaton_file(automaton)) {
      entry.fail("a scenario on a configuration of an automaton: " + automaton.string() +
                 " is a built one");
    }
    plan.automaton = automaton;
    plan.scenarios.push_back(scenario);
  }
  if (plan.scenarios.empty()) node.fail("scenarios", "a list with at least one scenario's file");
}

void read_subgraph_names(const Node& node, const std::vector<automaton::SubgraphSpec>& offered,
                         SweepPlan& plan) {
  for (const Node& entry : node.list("subgraphs")) {
    const auto name = entry.as<std::string>();
    if (scenario::find_subgraph(offered, name) == nullptr)
      entry.fail("one of " + scenario::names_of(offered));
    if (std::ranges::find(plan.subgraphs, name) != plan.subgraphs.end()) {
      entry.fail("unique");
    }
    plan.subgraphs.push_back(name);
  }
  if (plan.subgraphs.empty()) node.fail("subgraphs", "a list of " + scenario::names_of(offered));
}

std::vector<std::vector<std::size_t>> read_tables(const Node& node, const SweepPlan& plan) {
  std::vector<std::vector<std::size_t>> tables;
  if (!node.has("tables")) return tables;
  std::vector<std::string> settings;
  for (const SweepAxis& axis : plan.axes) settings.push_back(axis.setting);
  for (const Node& entry : node.list("tables")) {
    if (!entry.is_list()) entry.fail("a list of settings");
    std::vector<std::size_t> axes;
    for (const Node& one : entry.entries()) {
      const auto name = one.as<std::string>(one_of(settings));
      const auto axis =
          static_cast<std::size_t>(std::ranges::find(settings, name) - settings.begin());
      if (std::ranges::find(axes, axis) != axes.end()) one.fail("unique");
      axes.push_back(axis);
    }
    if (axes.size() < 2)
      entry.fail("a list of at least two settings; each alone has a table anyway");
    tables.push_back(std::move(axes));
  }
  return tables;
}

std::size_t grid_size(const SweepPlan& plan) {
  std::size_t size = 1;
  for (const SweepAxis& axis : plan.axes) size *= axis.values.size();
  return size;
}

void check_size(const Node& node, const SweepPlan& plan) {
  double size = static_cast<double>(plan.runs_each());
  for (const SweepAxis& axis : plan.axes) size *= static_cast<double>(axis.values.size());
  if (!plan.runs && size > kMaxRuns) {
    node.fail("settings", "a grid of <= " + shortest_text(kMaxRuns) + " runs, this one has " +
                              shortest_text(size) + "; `runs` drives a sample of it");
  }
  if (size > 1e15) node.fail("settings", "a grid of <= 1e15 runs");
}

}  // namespace

SweepPlan read_sweep(const std::filesystem::path& file) {
  const Node node = Node::read_yaml(file);
  SweepPlan plan{.file = file};
  read_scenarios(node, plan);
  const maneuver_design::AutomatonConfiguration automaton =
      maneuver_design::read_automaton_configuration(plan.automaton);
  read_subgraph_names(node, automaton.subgraphs, plan);
  plan.starts = node.optional<std::size_t>("starts", 1, between(1.0, 100000.0));
  plan.seed = node.optional<std::size_t>("seed", 1);
  if (node.has("steps")) {
    // More than the flying lap's first step: some steps must remain for the evaluation.
    plan.steps = node.required<std::size_t>(
        "steps", between(static_cast<double>(kFlyingStep) + 1.0, 100000.0));
  }
  if (node.has("runs")) plan.runs = node.required<std::size_t>("runs", between(1.0, kMaxRuns));
  plan.axes = read_axes(node.map("settings"), automaton.trims);
  if (plan.axes.empty()) node.fail("settings", "a map with at least one setting");
  plan.tables = read_tables(node, plan);
  check_size(node, plan);
  node.check_no_unknown_keys();
  return plan;
}

std::vector<SweepCombination> combinations_of(const SweepPlan& plan) {
  const std::size_t size = grid_size(plan);
  std::size_t count = size;
  if (plan.runs) count = std::min(size, (*plan.runs + plan.runs_each() - 1) / plan.runs_each());
  std::set<std::size_t> chosen;
  std::mt19937_64 random(plan.seed);
  // Floyd's draw without repetition: equally likely subsets in `count` draws.
  for (std::size_t last = size - count; last < size; ++last) {
    const std::size_t drawn = count == size ? last : random() % (last + 1);
    if (!chosen.insert(drawn).second) chosen.insert(last);
  }
  std::vector<SweepCombination> combinations;
  for (std::size_t number : chosen) {
    SweepCombination combination(plan.axes.size());
    for (std::size_t axis = plan.axes.size(); axis-- > 0;) {
      combination[axis] = number % plan.axes[axis].values.size();
      number /= plan.axes[axis].values.size();
    }
    combinations.push_back(std::move(combination));
  }
  return combinations;
}

const SweepValue* value_of(const SweepPlan& plan, const SweepCombination& combination,
                           const std::string& setting) {
  for (std::size_t axis = 0; axis < plan.axes.size(); ++axis) {
    if (plan.axes[axis].setting == setting) return &plan.axes[axis].values[combination[axis]];
  }
  return nullptr;
}

}  // namespace hlc::campaign
