// How fast the search engines are: every problem of every set is solved by a plain reference search
// and by all engines, one after the other in one process. See README.md beside this file.
#include <algorithm>
#include <chrono>
#include <iostream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "planner/apps/flags.hpp"
#include "planner/apps/output_files.hpp"
#include "planner/common/text_file.hpp"
#include "tests/benchmarks/contestants.hpp"
#include "tests/benchmarks/problem_sets.hpp"
#include "tests/benchmarks/search_report.hpp"

namespace {

struct Choices {
  hlc::apps::OutputFile json{"--json", {}};
  std::vector<std::string> sets;
  std::size_t problems{};  ///< 0: all
  std::string only;
  bool lists{};
};

hlc::test::Solved timed(hlc::test::Contestant& contestant,
                        const hlc::search::HorizonProblem& problem) {
  const auto begin = std::chrono::steady_clock::now();
  contestant.solve(problem);
  const auto end = std::chrono::steady_clock::now();
  hlc::test::Solved solved = contestant.solved();
  solved.time_us = std::chrono::duration<double, std::micro>(end - begin).count();
  return solved;
}

hlc::test::SetReport measure(const hlc::test::ProblemSet& set, const std::string& only) {
  const hlc::automaton::ReachableSets reachable(*set.subgraph, set.horizon_steps);
  std::vector<hlc::test::EngineRun> runs;
  std::vector<std::unique_ptr<hlc::test::Contestant>> contestants;
  for (const std::string& name : hlc::test::contestant_names()) {
    if (!only.empty() && name != only) continue;
    runs.push_back({name, {}});
    contestants.push_back(hlc::test::make_contestant(name, *set.subgraph, reachable));
    // Memory that an engine keeps is there before anything is measured.
    if (only.empty()) contestants.back()->solve(set.problems.front());
  }
  for (std::size_t i = 0; i < set.problems.size(); ++i) {
    for (std::size_t turn = 0; turn < runs.size(); ++turn) {
      // The first engine changes, so that no engine always runs with the caches of the same other
      // one.
      const std::size_t next = (i + turn) % runs.size();
      // As in a controller, the problem was created immediately before.
      const hlc::search::HorizonProblem posed = set.problems[i];
      runs[next].solved.push_back(timed(*contestants[next], posed));
    }
  }
  return hlc::test::report_on(set.name, runs, only.empty() ? &runs.front() : nullptr);
}

std::vector<std::string> all_sets() {
  std::vector<std::string> names;
  for (const auto& info : hlc::test::problem_set_infos()) names.push_back(info.name);
  return names;
}

void list() {
  for (const auto& info : hlc::test::problem_set_infos()) {
    std::cout << info.name << std::string(22 - info.name.size(), ' ') << info.what << '\n';
  }
}

/// True if every engine's every plan was a best one.
bool run(const Choices& choices) {
  hlc::apps::check_output_files({choices.json});
  hlc::apps::check_each_once("--sets", choices.sets);
  hlc::test::ProblemSets sets;
  std::vector<hlc::test::SetReport> reports;
  for (const std::string& name : choices.sets) {
    std::cerr << "search_benchmark: " << name << ", set " << reports.size() + 1 << " of "
              << choices.sets.size() << '\n';
    reports.push_back(measure(sets.make(name, choices.problems), choices.only));
    print(reports.back(), std::cout);
    std::cout.flush();
  }
  hlc::test::print_legend(std::cout);
  if (choices.json.file) {
    hlc::write_file(*choices.json.file, to_json(reports).dump(2) + '\n');
  }
  bool is_optimal = true;
  for (const hlc::test::SetReport& report : reports) {
    for (const hlc::test::EngineReport& engine : report.engines) {
      if (engine.optimal.value_or(true)) continue;
      is_optimal = false;
      std::cerr << "search_benchmark: " << report.name << ": " << engine.name
                << " does not agree with the reference\n";
    }
  }
  return is_optimal;
}

}  // namespace

int main(int argc, char** argv) {
  hlc::apps::CommandLine app{"Measures the search engines against a plain reference search.",
                             "search_benchmark"};
  Choices choices{.sets = all_sets()};
  hlc::apps::declare_output(app, choices.json, "also write the figures to this file (JSON)");
  app.add_option("--sets", choices.sets, "problem sets, separated by commas (default: all)")
      ->delimiter(',')
      ->check(hlc::apps::among(all_sets()));
  app.add_option("--problems", choices.problems, "only the first so many of each set")
      ->check(hlc::apps::whole(1, 1000000));
  app.add_option("--only", choices.only, "run this engine alone, once per problem")
      ->check(hlc::apps::among(hlc::test::contestant_names()));
  app.add_flag("--list", choices.lists, "name the sets and end");
  hlc::apps::declare_help_end(
      app, {.examples = {"search_benchmark --sets three_cars,cars_19", "search_benchmark --list"},
            .exit_codes = "0 success, 1 an engine's plan is not optimal, 2 invalid input or an "
                          "output that cannot be written"});
  if (const auto code = hlc::apps::parse_flags(app, argc, argv)) return *code;
  return hlc::apps::exit_code_of("search_benchmark", [&choices] {
    if (!choices.lists) return run(choices) ? 0 : 1;
    list();
    return 0;
  });
}
