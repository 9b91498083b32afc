// Solves a single planning problem from a file: a controller's planning step, or a problem written
// by hand.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>

#include "planner/apps/fitted_table.hpp"
#include "planner/apps/flags.hpp"
#include "planner/apps/joint_plan.hpp"
#include "planner/apps/output_files.hpp"
#include "planner/apps/search_json.hpp"
#include "planner/common/text_file.hpp"
#include "planner/plot/drawing.hpp"
#include "planner/plot/problem_data.hpp"
#include "planner/plot/search_page.hpp"
#include "planner/scenario/engine_choice.hpp"
#include "planner/scenario/joint_problem_file.hpp"
#include "planner/scenario/problem_file.hpp"
#include "planner/search/recorded_search.hpp"
#include "planner/search/search_engine.hpp"
#include "planner/search/search_options.hpp"

namespace {

using Json = nlohmann::ordered_json;
using Clock = std::chrono::steady_clock;

constexpr int kExitFallback = 1;
constexpr char kTreeEngine[] = "best_first";
/// The shortest of several calls is reported: the first one also allocates and fills caches.
constexpr int kMaxCalls = 20;
constexpr double kEnough_us = 2e4;

struct Flags {
  std::filesystem::path file;
  std::optional<std::filesystem::path> automaton;
  std::optional<std::string> engine;
  std::optional<std::string> cost_to_go;
  std::optional<std::size_t> max_expansions;
  bool json{};
  hlc::apps::OutputFile plot{"--plot", {}};
  hlc::apps::OutputFile tree{"--tree", {}};
};

struct Solved {
  hlc::search::SearchResult result;
  double planning_us{};
};

void declare(CLI::App& app, Flags& flags) {
  app.add_option(
         "PROBLEM", flags.file,
         "planning problem (JSON), as high_level_controller --dump_problems writes it, or a "
         "joint one of several vehicles, as price_of_priority --dump_problems does")
      ->required()
      ->type_name("FILE");
  app.add_option("--automaton", flags.automaton,
                 "automaton file, instead of the one that the problem names")
      ->type_name("FILE");
  app.add_option("--engine", flags.engine,
                 "search engine: " + hlc::scenario::engine_choices() +
                     " (default: the file's, else branch_and_bound)");
  app.add_option(
      "--cost_to_go", flags.cost_to_go,
      "reachable, straight_line or 2022; the last two with best_first (default: the file's)");
  app.add_option(
         "--max_expansions", flags.max_expansions,
         "budget, at least 1; of a joint problem: of all searches together (default 20000000)")
      ->check(hlc::apps::whole(1, hlc::search::SearchOptions::kMostExpansions));
  app.add_flag(
      "--json", flags.json,
      "print one JSON object: status (optimal, budget, unproven, fallback), reason (of a fallback: "
      "infeasible, budget), cost [m^2], lower_bound, gap, trims (n of them, after each "
      "step, from 1), poses ([x, y, psi] after each step), generated, expanded, "
      "planning_us. Of a joint problem: see planner/apps/joint_plan.hpp");
  hlc::apps::declare_output(app, flags.plot, "write a picture of problem and plan (SVG, PDF)");
  hlc::apps::declare_output(
      app, flags.tree,
      "write what was searched: FILE.html, a page with the search tree, what ruled out the other "
      "plans, and the runner-up; FILE.json, the same for other programs. Searches with best_first, "
      "also if the problem names another engine; cost-to-go reachable or straight_line");
  hlc::apps::declare_help_end(
      app, {.examples = {"plan_problem launch_scripts/problems/parked_car.json --plot plan.svg",
                         "plan_problem launch_scripts/problems/parked_car.json --engine best_first "
                         "--tree tree.html"},
            .exit_codes = "0 there is a plan, 1 there is none (fallback), 2 invalid input or an "
                          "output that cannot be written, 3 the plan is not drawn"});
}

/// Only the plain engine records its search.
void check_tree_flags(const Flags& flags) {
  if (!flags.tree.file) return;
  const std::string extension = flags.tree.file->extension().string();
  if (extension != ".html" && extension != ".json") {
    throw std::invalid_argument(
        fmt::format("--tree = {}, must end in .html or .json", flags.tree.file->string()));
  }
  if (flags.engine && *flags.engine != kTreeEngine) {
    throw std::invalid_argument(
        fmt::format("--engine = {} with --tree, must be {}", *flags.engine, kTreeEngine));
  }
}

/// Engine and cost-to-go of the command line, if given.
void choose_search(const Flags& flags, hlc::search::SearchOptions& search) {
  try {
    if (flags.tree.file) hlc::scenario::choose_engine(kTreeEngine, search);
    if (flags.engine) hlc::scenario::choose_engine(*flags.engine, search);
    if (flags.cost_to_go) search.cost_to_go = hlc::search::cost_to_go_from_name(*flags.cost_to_go);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(std::string("--") + error.what());
  }
}

hlc::scenario::ProblemFile read(const Flags& flags) {
  hlc::scenario::ProblemFile file = hlc::scenario::read_problem_file(flags.file, flags.automaton);
  choose_search(flags, file.search);
  try {
    if (flags.max_expansions) file.search.max_expansions = *flags.max_expansions;
    if (flags.tree.file) hlc::search::check_can_be_recorded(file.search);
    hlc::scenario::check_can_be_searched(file);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(flags.file.string() + ": " + error.what());
  }
  return file;
}

Solved solve(const hlc::scenario::ProblemFile& file) {
  const hlc::automaton::ReachableSets reachable(*file.subgraph, file.problem.horizon_steps());
  const auto engine = hlc::search::make_search_engine(*file.subgraph, reachable, file.search);
  Solved solved;
  double sum_us = 0.0;
  for (int call = 0; call < kMaxCalls && sum_us < kEnough_us; ++call) {
    const auto begin = Clock::now();
    solved.result = engine->search(file.problem);
    const double us = std::chrono::duration<double, std::micro>(Clock::now() - begin).count();
    solved.planning_us = call == 0 ? us : std::min(solved.planning_us, us);
    sum_us += us;
  }
  return solved;
}

Json to_json(const Solved& solved) {
  const hlc::search::SearchResult& result = solved.result;
  const bool has_plan = result.status != hlc::search::SearchStatus::kFallback;
  Json json;
  json["status"] = hlc::search::to_string(result.status);
  json["reason"] = hlc::search::to_string(result.reason);
  json["cost"] = has_plan ? Json(result.cost) : Json(nullptr);
  json["lower_bound"] = has_plan ? Json(result.lower_bound) : Json(nullptr);
  json["gap"] = has_plan ? Json(result.cost - result.lower_bound) : Json(nullptr);
  json["trims"] = Json::array();
  json["poses"] = Json::array();
  for (const hlc::automaton::Maneuver* maneuver : result.maneuvers) {
    json["trims"].push_back(maneuver->to.index + 1);
  }
  for (const hlc::Pose& pose : result.poses) {
    json["poses"].push_back({pose.x_m, pose.y_m, pose.heading_rad});
  }
  json["generated"] = result.generated;
  json["expanded"] = result.expanded;
  json["planning_us"] = solved.planning_us;
  return json;
}

std::string result_text(const hlc::scenario::ProblemFile& file, const Solved& solved) {
  const hlc::search::SearchResult& result = solved.result;
  const bool has_plan = result.status != hlc::search::SearchStatus::kFallback;
  std::string text = fmt::format(
      "engine           {}, cost-to-go {}, at most {} expansions\n"
      "status           {}{}\n",
      hlc::scenario::engine_name(file.search), hlc::search::to_string(file.search.cost_to_go),
      file.search.max_expansions, hlc::search::to_string(result.status),
      has_plan ? "" : fmt::format(": {}", hlc::search::to_string(result.reason)));
  if (has_plan) {
    const bool is_optimal = result.status == hlc::search::SearchStatus::kOptimal;
    text +=
        fmt::format("cost             {:.9g} m^2, {}\n", result.cost,
                    is_optimal ? "no plan costs less"
                               : fmt::format("a plan that costs up to {:.9g} m^2 less may exist",
                                             result.cost - result.lower_bound));
    if (result.status == hlc::search::SearchStatus::kUnproven) {
      text += "                 the cost-to-go of 2022 may overestimate\n";
    }
  }
  return text + fmt::format(
                    "vertices         {} generated, {} expanded\n"
                    "planning time    {:.1f} us\n",
                    result.generated, result.expanded, solved.planning_us);
}

std::string plan_table(const hlc::search::HorizonProblem& problem,
                       const hlc::search::SearchResult& result) {
  std::string text = fmt::format("{:>4}  {:>4}  {:<8} {:>9} {:>9} {:>9}  {:>9} {:>9}  {:>12}\n",
                                 "step", "trim", "maneuver", "x [m]", "y [m]", "psi [rad]",
                                 "ref_x [m]", "ref_y [m]", "distance [m]");
  text += fmt::format("{:>4}  {:>4}  {:<8} {:>9.3f} {:>9.3f} {:>9.3f}\n", 0,
                      problem.start_trim.index + 1, "start", problem.start.x_m, problem.start.y_m,
                      problem.start.heading_rad);
  for (std::size_t j = 0; j < result.maneuvers.size(); ++j) {
    const hlc::Pose& pose = result.poses[j];
    const hlc::Point& reference_m = problem.reference_m[j];
    text += fmt::format(
        "{:>4}  {:>4}  {:<8} {:>9.3f} {:>9.3f} {:>9.3f}  {:>9.3f} {:>9.3f}  {:>12.3f}\n", j + 1,
        result.maneuvers[j]->to.index + 1, result.maneuvers[j]->label, pose.x_m, pose.y_m,
        pose.heading_rad, reference_m.x(), reference_m.y(),
        (pose.position_m() - reference_m).norm());
  }
  return text;
}

void print(const hlc::scenario::ProblemFile& file, const Solved& solved) {
  std::cout << hlc::apps::fitted_lines(result_text(file, solved));
  if (solved.result.status == hlc::search::SearchStatus::kFallback) return;
  std::cout << '\n' << hlc::apps::fitted_table(plan_table(file.problem, solved.result));
}

void write_tree(const hlc::scenario::ProblemFile& file, const std::filesystem::path& path) {
  const hlc::automaton::ReachableSets reachable(*file.subgraph, file.problem.horizon_steps());
  const hlc::search::RecordedSearch recorded =
      hlc::search::record_search(*file.subgraph, reachable, file.search, file.problem);
  hlc::write_file(path, path.extension() == ".html" ? hlc::plot::search_page(file, recorded)
                                                    : hlc::apps::search_json(file, recorded));
}

/// Problem and plan, if asked for. @return 0 or the exit code
template <class File, class Result>
int draw(const Flags& flags, const File& file, const Result& result) {
  if (!flags.plot.file) return 0;
  return hlc::plot::draw("problem", hlc::plot::problem_data(file, result), *flags.plot.file);
}

int run_joint(const Flags& flags) {
  if (flags.tree.file) {
    throw std::invalid_argument(fmt::format("--tree = {}, must be absent: {} is a joint problem",
                                            flags.tree.file->string(), flags.file.string()));
  }
  hlc::scenario::JointProblemFile file =
      hlc::scenario::read_joint_problem_file(flags.file, flags.automaton);
  choose_search(flags, file.search);
  hlc::apps::check_output_files({flags.plot}, {flags.file, file.automaton_file});
  hlc::joint_search::JointSearchOptions options;
  if (flags.max_expansions) options.max_expansions = *flags.max_expansions;
  hlc::apps::TimedSolution timed;
  try {
    hlc::search::check_search_options(file.search);
    timed = hlc::apps::solve(file, options);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(flags.file.string() + ": " + error.what());
  }
  if (flags.json) {
    std::cout << hlc::apps::json_of(timed) << '\n';
  } else {
    hlc::apps::print(file, timed);
  }
  if (const int code = draw(flags, file, timed.solution.joint); code != 0) return code;
  return timed.solution.joint.plans.empty() ? kExitFallback : 0;
}

int run(const Flags& flags) {
  check_tree_flags(flags);
  hlc::apps::check_output_files({flags.plot, flags.tree}, {flags.file});
  if (hlc::scenario::is_joint_problem_file(flags.file)) return run_joint(flags);
  const hlc::scenario::ProblemFile file = read(flags);
  hlc::apps::check_output_files({flags.plot, flags.tree}, {flags.file, file.automaton_file});
  const Solved solved = solve(file);
  if (flags.json) {
    std::cout << to_json(solved).dump() << '\n';
  } else {
    print(file, solved);
  }
  if (flags.tree.file) write_tree(file, *flags.tree.file);
  if (const int code = draw(flags, file, solved.result); code != 0) return code;
  return solved.result.status == hlc::search::SearchStatus::kFallback ? kExitFallback : 0;
}

}  // namespace

int main(int argc, char** argv) {
  hlc::apps::CommandLine app{
      "Solves one planning problem from a file, or a joint one of several vehicles.",
      "plan_problem"};
  Flags flags;
  declare(app, flags);
  if (const auto code = hlc::apps::parse_flags(app, argc, argv)) return *code;
  return hlc::apps::exit_code_of("plan_problem", [&flags] { return run(flags); });
}
