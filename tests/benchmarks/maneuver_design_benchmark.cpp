// How long the maneuvers of the paper's universal automaton take, criterion by criterion, all of
// it, and its subgraphs with their tables, in CPU time on one core:
// maneuver_design_benchmark [INTERVALS] [CONFIG.yaml]
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "planner/automaton/subgraph.hpp"
#include "planner/common/yaml_text.hpp"
#include "planner/controller/controller.hpp"
#include "planner/geometry/median.hpp"
#include "planner/maneuver_design/automaton_builder.hpp"
#include "planner/maneuver_design/criteria.hpp"
#include "planner/maneuver_design/solver/maneuver_solver.hpp"
#include "tests/support/folders.hpp"

namespace {

double cpu_ms() { return 1e3 * static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

struct Row {
  std::vector<double> times_ms;
  std::size_t not_optimal{};
  int evaluations{};
  double residual{};
};

Row measured(const hlc::maneuver_design::AutomatonConfiguration& c,
             const std::set<hlc::TrimPair>& edges, const std::string& criterion) {
  Row row;
  const auto cost = hlc::maneuver_design::make_criterion(criterion, c.vehicle);
  for (const hlc::TrimPair& edge : edges) {
    const double begin_ms = cpu_ms();
    const hlc::maneuver_design::ManeuverSolution solution =
        hlc::maneuver_design::solve({c.trims[edge.from.index], c.trims[edge.to.index], c.step_s,
                                     c.intervals, c.vehicle, c.limits},
                                    *cost);
    row.times_ms.push_back(cpu_ms() - begin_ms);
    row.not_optimal += solution.status == hlc::maneuver_design::ManeuverStatus::kOptimal ? 0 : 1;
    row.evaluations += solution.evaluations;
    row.residual = std::max(row.residual, solution.first_order_residual);
  }
  std::sort(row.times_ms.begin(), row.times_ms.end());
  return row;
}

/// Reaction of a controller to a request for new weights, on the largest subgraph.
void print_new_weights(hlc::maneuver_design::AutomatonConfiguration configuration, double first,
                       double second) {
  const auto size = [](const hlc::automaton::SubgraphSpec& spec) { return spec.trims.size(); };
  hlc::automaton::SubgraphSpec largest =
      *std::ranges::max_element(configuration.subgraphs, {}, size);
  largest.labels = {"J1 " + hlc::shortest_text(first) + " J2 " + hlc::shortest_text(second)};
  largest.edges.clear();
  configuration.criteria = {
      {.label = largest.labels.front(), .weights = {{"J1", first}, {"J2", second}}}};
  configuration.subgraphs = {largest};
  const double begin_ms = cpu_ms();
  const std::vector<hlc::automaton::Maneuver> designed = hlc::maneuver_design::design(
      configuration, hlc::maneuver_design::design_tasks(configuration));
  std::printf("%-18s %9.1f  (%zu maneuvers with swept areas)\n", largest.labels.front().c_str(),
              cpu_ms() - begin_ms, designed.size());
}

/// What is done before a controller switches to a subgraph, and what the switch takes then.
void print_switching(const std::shared_ptr<const hlc::automaton::UniversalAutomaton>& automaton,
                     const hlc::automaton::SubgraphSpec& spec, std::size_t horizon_steps) {
  const double begin_ms = cpu_ms();
  const auto subgraph = std::make_shared<const hlc::automaton::Subgraph>(automaton, spec);
  const double view_ms = cpu_ms();
  const hlc::controller::PreparedSubgraph prepared =
      hlc::controller::prepare_subgraph(subgraph, horizon_steps, {});
  const double prepared_ms = cpu_ms();
  hlc::controller::Controller controller({.vehicle = {1}, .horizon_steps = horizon_steps}, subgraph,
                                         hlc::road::ReferencePath({{0.0, 0.0}, {10.0, 0.0}}, false),
                                         {});
  const double made_ms = cpu_ms();
  controller.switch_to(prepared);
  std::printf("%-18s %9.2f  prepared for %zu steps: %.1f, switched to: %.3f\n",
              ("Subgraph " + spec.name).c_str(), view_ms - begin_ms, horizon_steps,
              prepared_ms - view_ms, cpu_ms() - made_ms);
}

}  // namespace

int main(int argc, char** argv) {
  hlc::maneuver_design::AutomatonConfiguration configuration =
      hlc::maneuver_design::read_automaton_configuration(
          argc > 2 ? argv[2] : hlc::test::source_folder() + "/launch_scripts/automata/paper.yaml");
  if (argc > 1) configuration.intervals = std::strtoul(argv[1], nullptr, 10);
  std::set<hlc::TrimPair> edges;
  for (const hlc::maneuver_design::DesignTask& task :
       hlc::maneuver_design::design_tasks(configuration))
    edges.insert(task.edge);
  std::printf("%zu edges, N = %zu, CPU time on one core\n", edges.size(), configuration.intervals);
  std::printf("%-18s %9s %11s %10s %13s %13s %12s\n", "criterion", "all [ms]", "median [ms]",
              "max [ms]", "evaluations", "max residual", "not optimal");
  double total_ms = 0.0;
  for (const std::string criterion : {"J1", "J2", "J3", "comfort", "energy"}) {
    const Row row = measured(configuration, edges, criterion);
    double sum_ms = 0.0;
    for (const double time_ms : row.times_ms) sum_ms += time_ms;
    if (criterion[0] == 'J') total_ms += sum_ms;
    std::printf("%-18s %9.1f %11.2f %10.2f %13d %13.1e %12zu\n", criterion.c_str(), sum_ms,
                hlc::median(row.times_ms), row.times_ms.back(), row.evaluations, row.residual,
                row.not_optimal);
  }
  std::printf("%-18s %9.1f\n", "J1, J2, J3", total_ms);
  print_new_weights(configuration, 0.3, 0.7);
  print_new_weights(configuration, 1.0, 0.001);
  print_new_weights(configuration, 1.0, 0.0);
  const double begin_ms = cpu_ms();
  const auto automaton = std::make_shared<const hlc::automaton::UniversalAutomaton>(
      hlc::maneuver_design::build_automaton(configuration));
  std::printf("%-18s %9.1f  (%zu maneuvers with swept areas)\n", "build_automaton",
              cpu_ms() - begin_ms, automaton->maneuvers.size());
  for (const hlc::automaton::SubgraphSpec& spec : configuration.subgraphs) {
    print_switching(automaton, spec, configuration.horizon_steps);
  }
  return 0;
}
