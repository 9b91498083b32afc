// Compares our planner with OMPL's own kinodynamic planners on the same problem: same start, same
// goal, same obstacles, same motions, same cost.
//
// Read it as an example of how the pieces fit together: a space information with controls
// (planner/search/ompl/ompl_control.hpp), a goal and an objective (ompl_problem.hpp), the planner
// (ompl_planner.hpp), and OMPL's SimpleSetup, Benchmark and PlannerData, which are independent of
// the rest.
#include <ompl/base/ProjectionEvaluator.h>
#include <ompl/control/PlannerData.h>
#include <ompl/control/SimpleSetup.h>
#include <ompl/control/planners/kpiece/KPIECE1.h>
#include <ompl/control/planners/rrt/RRT.h>
#include <ompl/control/planners/sst/SST.h>
#include <ompl/tools/benchmark/Benchmark.h>
#include <ompl/util/RandomNumbers.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "planner/apps/flags.hpp"
#include "planner/apps/interruption.hpp"
#include "planner/apps/output_files.hpp"
#include "planner/apps/progress_line.hpp"
#include "planner/common/text_file.hpp"
#include "planner/common/yaml_text.hpp"
#include "planner/geometry/median.hpp"
#include "planner/scenario/problem_file.hpp"
#include "planner/search/ompl/ompl_control.hpp"
#include "planner/search/ompl/ompl_planner.hpp"
#include "planner/search/search_options.hpp"

namespace ob = ompl::base;
namespace oc = ompl::control;
namespace ot = ompl::tools;

#if defined(__SANITIZE_ADDRESS__)
// OMPL 1.5's SST never frees the motions of witnesses that it has searched; the leak sanitizer asks
// these functions what not to report, and needs whole stacks to recognise SST in them.
extern "C" const char* __asan_default_options();
extern "C" const char* __asan_default_options() { return "fast_unwind_on_malloc=0"; }
extern "C" const char* __lsan_default_options();
extern "C" const char* __lsan_default_options() { return "print_suppressions=0"; }
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() {
  return "leak:ompl::control::SST::findClosestWitness\n";
}
#endif

namespace {

constexpr char kCost[] = "path cost REAL";
constexpr char kIsOptimal[] = "optimal BOOLEAN";
constexpr char kShipped[] = "launch_scripts/problems/parked_car.json";
/// Prefix that OMPL's Benchmark puts before names of control planners.
constexpr std::string_view kPrefix = "control_";
constexpr int kBareCalls = 20;

struct Flags {
  std::filesystem::path file;
  double seconds{0.2};
  unsigned runs{5};
  double radius_m{0.5};
  unsigned seed{1};
  hlc::apps::OutputFile log{"--log", {}};
};

void declare(CLI::App& app, Flags& flags) {
  app.add_option("PROBLEM", flags.file,
                 std::string("planning problem (JSON, see plan_problem), for example ") + kShipped)
      ->required()
      ->type_name("FILE");
  app.add_option("--time_s", flags.seconds, "that each planner has per run")
      ->check(hlc::apps::within(0.001, 3600.0))
      ->capture_default_str();
  app.add_option("--runs", flags.runs, "number of runs of each planner")
      ->check(hlc::apps::whole(1, 10000))
      ->capture_default_str();
  app.add_option("--radius_m", flags.radius_m,
                 "of the goal: standing after the last step, not farther than this from the last "
                 "reference point")
      ->check(hlc::apps::within(0.0, 1e4))
      ->capture_default_str();
  app.add_option("--seed", flags.seed, "of OMPL's random numbers")
      ->check(hlc::apps::whole(1, 1 << 30))
      ->capture_default_str();
  hlc::apps::declare_output(
      app, flags.log, "write the benchmark's log there, for OMPL's ompl_benchmark_statistics.py");
  hlc::apps::declare_help_end(
      app,
      {.examples = {"ompl_example launch_scripts/problems/parked_car.json",
                    "ompl_example launch_scripts/problems/parked_car.json --time_s 1 --runs 20 "
                    "--log ompl.log"},
       .exit_codes =
           "0 success, 2 invalid input or an output that cannot be written, 130 interrupted",
       .notes = "Of the file's `search`, max_expansions holds for this planner, which is run with "
                "each of its engines, and cost_to_go for best_first; criterion_weights are "
                "refused: the planners are compared by the distance from the reference alone."});
}

/// KPIECE covers this plane with cells.
class PositionProjection final : public ob::ProjectionEvaluator {
 public:
  explicit PositionProjection(const ob::StateSpacePtr& space) : ProjectionEvaluator(space) {}
  unsigned getDimension() const override { return 2; }
  void defaultCellSizes() override { cellSizes_ = {0.1, 0.1}; }
  void project(const ob::State* state, Eigen::Ref<Eigen::VectorXd> projection) const override {
    projection = hlc::search::read_state(*state).pose.position_m();
  }
};

/// This planner with each of its engines, then OMPL's.
std::vector<ob::PlannerPtr> make_planners(const std::shared_ptr<oc::SpaceInformation>& si,
                                          const hlc::scenario::ProblemFile& file,
                                          const hlc::automaton::ReachableSets& reachable) {
  std::vector<ob::PlannerPtr> planners;
  for (const hlc::search::Engine engine :
       {hlc::search::Engine::kBranchAndBound, hlc::search::Engine::kBestFirst}) {
    hlc::search::SearchOptions options = file.search;
    if (engine == hlc::search::Engine::kBranchAndBound)
      options.cost_to_go = hlc::search::CostToGo::kReachable;
    auto planner = std::make_shared<hlc::search::RecedingHorizonPlanner>(si, *file.subgraph,
                                                                         reachable, options);
    planner->params().setParam("engine", hlc::search::to_string(engine));
    planner->setName(std::string("this planner, ") + hlc::search::to_string(engine));
    planners.push_back(planner);
  }
  planners.push_back(std::make_shared<oc::RRT>(si));
  auto sst = std::make_shared<oc::SST>(si);
  sst->setPruningRadius(0.01);  // metres: far below the length of a step
  sst->setSelectionRadius(0.05);
  planners.push_back(sst);
  planners.push_back(std::make_shared<oc::KPIECE1>(si));
  return planners;
}

double number(const ot::Benchmark::RunProperties& run, const char* name) {
  const auto found = run.find(name);
  return found == run.end() ? 0.0 : std::stod(found->second);
}

/// What the costs of a planner's plans mean.
const char* kind_of_plans(const ot::Benchmark::PlannerExperiment& experiment,
                          const ob::Planner& planner) {
  const auto is_optimal = [](const ot::Benchmark::RunProperties& run) {
    return !run.contains(kCost) || run.at(kIsOptimal) == "1";
  };
  if (const auto* ours = dynamic_cast<const hlc::search::RecedingHorizonPlanner*>(&planner)) {
    if (!hlc::search::is_admissible(ours->options().cost_to_go)) return "first found";
    return std::ranges::all_of(experiment.runs, is_optimal) ? "optimal" : "best so far";
  }
  return dynamic_cast<const oc::SST*>(&planner) != nullptr ? "best so far" : "first found";
}

void print(const ot::Benchmark::PlannerExperiment& planner, const char* kind) {
  std::vector<double> times_ms;
  std::vector<double> costs_m2;
  for (const auto& run : planner.runs) {
    times_ms.push_back(1e3 * number(run, "time REAL"));
    if (run.contains(kCost)) costs_m2.push_back(number(run, kCost));
  }
  const std::size_t prefix = planner.name.starts_with(kPrefix) ? kPrefix.size() : 0;
  std::printf("%-32s %5zu %7zu %10.2f %10.2f", planner.name.c_str() + prefix, planner.runs.size(),
              costs_m2.size(), hlc::median(times_ms), std::ranges::max(times_ms));
  if (costs_m2.empty()) {
    std::printf(" %12s %12s  %s\n", "-", "-", "none");
  } else {
    std::printf(" %12.5f %12.5f  %s\n", std::ranges::min(costs_m2), hlc::median(costs_m2), kind);
  }
}

void forget_plans(ob::Planner& planner, const ob::ProblemDefinitionPtr& definition) {
  planner.clear();
  definition->clearSolutionPaths();
  planner.setProblemDefinition(definition);
}

/// Shortest time of a `solve` without monitoring; nothing if none finishes within `seconds`.
std::optional<double> bare_solve_us(ob::Planner& planner,
                                    const ob::ProblemDefinitionPtr& definition, double seconds) {
  const auto time_is_up = ob::timedPlannerTerminationCondition(seconds);
  std::optional<double> shortest_us;
  for (int call = 0; call < kBareCalls && !time_is_up; ++call) {
    forget_plans(planner, definition);
    const auto begin = std::chrono::steady_clock::now();
    planner.solve(time_is_up);
    const std::chrono::duration<double, std::micro> took = std::chrono::steady_clock::now() - begin;
    if (!time_is_up) shortest_us = std::min(shortest_us.value_or(took.count()), took.count());
  }
  return shortest_us;
}

void print_alone(ob::Planner& planner, const ob::ProblemDefinitionPtr& definition, double seconds) {
  const std::optional<double> shortest_us = bare_solve_us(planner, definition, seconds);
  std::printf("%s alone: ", planner.getName().c_str());
  if (shortest_us) {
    std::printf("%.1f us\n", *shortest_us);
  } else {
    std::printf("more than %g s\n", seconds);
  }
  std::fflush(stdout);
}

void print(const ob::State& at) {
  const hlc::search::HorizonState state = hlc::search::read_state(at);
  std::printf("x %.3f m, y %.3f m, psi %.3f rad, trim %zu", state.pose.x_m, state.pose.y_m,
              state.pose.heading_rad, state.trim.index + 1);
}

/// The PlannerData of the last `solve` as text: OMPL's interface for drawing or storing it.
void print_data(const ob::Planner& planner, const ob::SpaceInformationPtr& si) {
  oc::PlannerData data(std::dynamic_pointer_cast<oc::SpaceInformation>(si));
  planner.getPlannerData(data);
  std::printf("\nPlannerData of %s: %u vertices, %u edges\n", planner.getName().c_str(),
              data.numVertices(), data.numEdges());
  for (unsigned from = 0; from < data.numVertices(); ++from) {
    std::printf("  vertex %u: ", from);
    print(*data.getVertex(from).getState());
    std::printf("%s%s\n", data.isStartVertex(from) ? ", start" : "",
                data.isGoalVertex(from) ? ", goal" : "");
    std::vector<unsigned> next;
    data.getEdges(from, next);
    for (const unsigned to : next) {
      ob::Cost cost;
      data.getEdgeWeight(from, to, &cost);
      const auto& edge = dynamic_cast<const oc::PlannerDataEdgeControl&>(data.getEdge(from, to));
      std::printf("  edge to vertex %u: one control for %g s, costs %.5f m^2\n", to,
                  edge.getDuration(), cost.value());
    }
  }
}

/// @throws std::invalid_argument
void check_can_be_compared(const hlc::scenario::ProblemFile& file,
                           const std::filesystem::path& path) {
  try {
    hlc::scenario::check_can_be_searched(file);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(path.string() + ": " + error.what());
  }
  const auto& weights = file.search.criterion_weights;
  if (weights.empty()) return;
  throw std::invalid_argument(
      path.string() + ": search.criterion_weights." + weights.front().criterion + " = " +
      hlc::shortest_text(weights.front().weight_m2) +
      ", must be absent: the planners are compared by the distance from the "
      "reference alone");
}

void print_table(const Flags& flags, const hlc::scenario::ProblemFile& file,
                 const ot::Benchmark& benchmark, const std::vector<ob::PlannerPtr>& planners) {
  std::printf("%zu steps, goal: standing within %g m of the last reference point; %g s per run\n\n",
              file.problem.horizon_steps(), flags.radius_m, flags.seconds);
  std::printf("%-32s %5s %7s %10s %10s %12s %12s\n", "", "", "", "time [ms]", "", "cost [m^2]", "");
  std::printf("%-32s %5s %7s %10s %10s %12s %12s  %s\n", "planner", "runs", "solved", "median",
              "max", "best", "median", "plans");
  const auto& experiments =
      benchmark.getRecordedExperimentData().planners;  // in the order of adding
  for (std::size_t i = 0; i < experiments.size(); ++i) {
    print(experiments[i], kind_of_plans(experiments[i], *planners[i]));
  }
  std::printf(
      "\nPlans: optimal: none costs less. best so far: when the time or max_expansions was used "
      "up.\nfirst found: RRT and KPIECE1 stop at their first solution%s; SST uses all its time.\n"
      "Times are Benchmark's, including its threads that run and monitor a planner.\n",
      hlc::search::is_admissible(file.search.cost_to_go) ? ""
                                                         : ", and so does best_first with 2022");
  std::fflush(stdout);
}

int run(const Flags& flags) {
  hlc::apps::check_output_files({flags.log}, {flags.file});
  const hlc::scenario::ProblemFile file = hlc::scenario::read_problem_file(flags.file);
  hlc::apps::check_output_files({flags.log}, {file.automaton_file});
  check_can_be_compared(file, flags.file);
  const hlc::search::HorizonProblem& problem = file.problem;
  const hlc::automaton::ReachableSets reachable(*file.subgraph, problem.horizon_steps());

  const auto si = hlc::search::make_control_space_information(*file.subgraph, reachable, problem);
  si->getStateSpace()->registerDefaultProjection(
      std::make_shared<PositionProjection>(si->getStateSpace()));
  oc::SimpleSetup setup(si);
  ob::ScopedState<> start(si);
  hlc::search::write_state({problem.start, problem.start_trim, 0}, *start.get());
  setup.setStartState(start);
  setup.setGoal(
      std::make_shared<hlc::search::StandstillGoal>(si, *file.subgraph, problem, flags.radius_m));
  setup.setOptimizationObjective(
      std::make_shared<hlc::search::SquaredDistanceObjective>(si, problem));

  ompl::RNG::setSeed(flags.seed);
  ot::Benchmark benchmark(setup, "receding horizon");
  const std::vector<ob::PlannerPtr> planners = make_planners(si, file, reachable);
  for (const ob::PlannerPtr& planner : planners) benchmark.addPlanner(planner);
  const hlc::apps::Interruption interruption(
      "ompl_example", "no log is written yet: the same command begins from the start");
  const hlc::apps::ProgressLine progress("run", planners.size() * flags.runs);
  std::size_t done = 0;
  benchmark.setPostRunEvent([&](const ob::PlannerPtr& planner, ot::Benchmark::RunProperties& run) {
    progress.show(++done);
    const ob::ProblemDefinitionPtr& definition = planner->getProblemDefinition();
    if (!definition->hasExactSolution()) return;
    const auto& path = dynamic_cast<const oc::PathControl&>(*definition->getSolutionPath());
    const ob::Cost cost = hlc::search::path_cost(path, *definition->getOptimizationObjective());
    run[kCost] = hlc::shortest_text(cost.value());
    run[kIsOptimal] = definition->getSolutions().front().optimized_ ? "1" : "0";
  });
  ot::Benchmark::Request request(flags.seconds, 4096.0, flags.runs);
  request.displayProgress = false;
  request.saveConsoleOutput = false;
  benchmark.benchmark(request);

  print_table(flags, file, benchmark, planners);
  for (const ob::PlannerPtr& planner : planners) {
    if (dynamic_cast<const hlc::search::RecedingHorizonPlanner*>(planner.get()) == nullptr)
      continue;
    print_alone(*planner, setup.getProblemDefinition(), flags.seconds);
  }
  forget_plans(*planners.front(), setup.getProblemDefinition());
  planners.front()->solve(flags.seconds);
  print_data(*planners.front(), si);
  if (flags.log.file) {
    std::ostringstream log;
    benchmark.saveResultsToStream(log);
    hlc::write_file(*flags.log.file, log.str());
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  hlc::apps::CommandLine app{
      "Compares this planner with OMPL's own kinodynamic planners on one problem.", "ompl_example"};
  Flags flags;
  declare(app, flags);
  if (const auto code = hlc::apps::parse_flags(app, argc, argv, {{"--seconds", "--time_s"}})) {
    return *code;
  }
  return hlc::apps::exit_code_of("ompl_example", [&flags] { return run(flags); });
}
