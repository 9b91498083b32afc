// Prints the content of an automaton file.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "planner/apps/flags.hpp"
#include "planner/maneuver_design/built_automaton.hpp"

namespace {

using hlc::TrimId;
using hlc::automaton::AutomatonFile;
using hlc::automaton::Maneuver;

void print_head(const AutomatonFile& file, const std::string& path) {
  const hlc::automaton::UniversalAutomaton& automaton = *file.automaton;
  std::printf("automaton  %s\n", path.c_str());
  std::printf("built from %s, sha256 %.16s..., %zu intervals per maneuver\n",
              file.configuration_file.c_str(), file.configuration_sha256.c_str(),
              file.automaton->maneuvers.front().inputs.size());
  const hlc::vehicle::VehicleLimits& limits = automaton.limits;
  std::printf(
      "vehicle    wheelbase %g m, rear axle to centre of gravity %g m, %g m x %g m, margin %g m\n",
      automaton.vehicle.wheelbase_m, automaton.vehicle.rear_axle_to_cg_m,
      automaton.vehicle.footprint.length_m, automaton.vehicle.footprint.width_m,
      automaton.vehicle.safety_margin_m);
  std::printf("limits     +-%g m/s^2, +-%g rad/s, %g ... %g m/s, +-%g rad",
              limits.acceleration_mps2, limits.steering_rate_radps, limits.speed_min_mps,
              limits.speed_max_mps, limits.steering_max_rad);
  if (limits.friction_mps2) std::printf(", friction circle %g m/s^2", *limits.friction_mps2);
  if (limits.curvature_max_per_m) std::printf(", curvature %g 1/m", *limits.curvature_max_per_m);
  std::printf("\n");
  std::printf("step       %g s\n", automaton.step_s);
}

/// Trims with the number of other trims that they have edges to and from, and their unit costs.
void print_trims(const hlc::automaton::UniversalAutomaton& automaton) {
  std::printf(
      "\ntrims, with the number of edges to and from other trims, and unit costs "
      "[1/s]\n");
  std::printf("%4s %9s %14s %4s %5s", "trim", "v [m/s]", "delta [rad]", "out", "in");
  for (const hlc::CriterionValue& cost : automaton.unit_costs.front()) {
    std::printf(" %*s", std::max(10, static_cast<int>(cost.name.size())), cost.name.c_str());
  }
  std::printf("\n");
  for (std::size_t i = 0; i < automaton.trims.size(); ++i) {
    std::vector<TrimId> targets;
    std::vector<TrimId> sources;
    const auto note = [](std::vector<TrimId>& list, TrimId trim) {
      if (std::ranges::find(list, trim) == list.end()) list.push_back(trim);
    };
    for (const Maneuver& m : automaton.maneuvers) {
      if (m.from == m.to) continue;
      if (m.from.index == i) note(targets, m.to);
      if (m.to.index == i) note(sources, m.from);
    }
    std::printf("%4zu %9g %14g %4zu %5zu", i + 1, automaton.trims[i].speed_mps,
                automaton.trims[i].steering_rad, targets.size(), sources.size());
    for (const hlc::CriterionValue& cost : automaton.unit_costs[i]) {
      std::printf(" %*.4g", std::max(10, static_cast<int>(cost.name.size())), cost.value);
    }
    std::printf("\n");
  }
  std::printf("J1 and stopping_distance have none: they depend on the position.\n");
}

struct Range {
  double min{std::numeric_limits<double>::infinity()};
  double max{-std::numeric_limits<double>::infinity()};

  void add(double value) {
    min = std::min(min, value);
    max = std::max(max, value);
  }
};

void print_labels(const AutomatonFile& file) {
  std::printf(
      "\nmaneuvers by label, with the ranges of displacement and of the largest speed on the "
      "way\n");
  std::printf("%-12s %6s %19s %19s %19s %15s\n", "label", "edges", "dx [m]", "dy [m]", "dpsi [rad]",
              "v_max [m/s]");
  std::vector<std::string> labels{hlc::automaton::kSelfLoopLabel};
  labels.insert(labels.end(), file.labels.begin(), file.labels.end());
  for (const std::string& label : labels) {
    std::size_t edges = 0;
    Range x;
    Range y;
    Range heading;
    Range speed;
    for (const Maneuver& m : file.automaton->maneuvers) {
      if (m.label != label) continue;
      ++edges;
      x.add(m.displacement.x_m);
      y.add(m.displacement.y_m);
      heading.add(m.displacement.heading_rad);
      speed.add(hlc::automaton::top_speed_mps(m));
    }
    if (edges == 0) continue;
    std::printf("%-12s %6zu %8.4f...%8.4f %8.4f...%8.4f %8.4f...%8.4f %6.3f...%6.3f\n",
                label.c_str(), edges, x.min, x.max, y.min, y.max, heading.min, heading.max,
                speed.min, speed.max);
  }
}

void print_subgraphs(const AutomatonFile& file) {
  std::printf(
      "\nsubgraphs: enabled trims, edges between them, disabled trims with exit edges,\n"
      "and for each trim the steps to standstill (- : cannot be planned from)\n");
  std::printf("%-12s %-12s %-10s %6s %6s %6s  %s\n", "name", "labels", "rule", "trims", "edges",
              "disabled", "steps to standstill of trims 1, 2, ...");
  for (const hlc::automaton::SubgraphSpec& spec : file.subgraphs) {
    const hlc::automaton::Subgraph subgraph(file.automaton, spec);
    std::size_t edges = 0;
    for (const TrimId trim : subgraph.trims()) {
      for (const hlc::automaton::Edge& edge : subgraph.successors(trim))
        edges += edge.to == trim ? 0U : 1U;
    }
    std::printf("%-12s %-12s %-10s %6zu %6zu %6zu ", spec.name.c_str(),
                fmt::format("{}", fmt::join(spec.labels, "+")).c_str(),
                spec.rule == hlc::automaton::EdgeRule::kChain ? "chain" : "reachable",
                subgraph.trims().size(), edges,
                subgraph.start_trims().size() - subgraph.trims().size());
    for (std::size_t i = 0; i < file.automaton->trims.size(); ++i) {
      const std::size_t steps = subgraph.distance_to_standstill({i});
      std::printf(" %s",
                  steps == hlc::automaton::Subgraph::kNever ? "-" : fmt::to_string(steps).c_str());
    }
    std::printf("\n");
  }
}

}  // namespace

int main(int argc, char** argv) {
  hlc::apps::CommandLine app{"Checks an automaton file and prints its content.", "show_automaton"};
  std::filesystem::path path;
  std::optional<std::filesystem::path> configuration;
  app.add_option("AUTOMATON", path, "file written by build_automaton")
      ->required()
      ->type_name("FILE");
  app.add_option("--configuration", configuration,
                 "automaton configuration (YAML) that it must be built from (default: the one in "
                 "the same folder, if any)")
      ->type_name("FILE");
  hlc::apps::declare_help_end(app,
                              {.examples = {"show_automaton /tmp/paper_automaton.yaml",
                                            "show_automaton /tmp/paper_automaton.yaml "
                                            "--configuration launch_scripts/automata/paper.yaml"},
                               .exit_codes = "0 success, 2 invalid input or an output that cannot "
                                             "be written; a stale or edited file is invalid"});
  if (const auto code = hlc::apps::parse_flags(app, argc, argv)) return *code;
  return hlc::apps::exit_code_of("show_automaton", [&] {
    const AutomatonFile file = hlc::maneuver_design::read_current_automaton_file(path);
    if (configuration) hlc::maneuver_design::check_is_current(file, path, *configuration);
    print_head(file, path.string());
    print_trims(*file.automaton);
    print_labels(file);
    print_subgraphs(file);
  });
}
