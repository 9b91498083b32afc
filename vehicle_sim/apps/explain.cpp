// Why a vehicle did what it did in a step of a run in logical time.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <iostream>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "hlc_bridge/apps/finished_run.hpp"
#include "hlc_bridge/messages/exit_codes.hpp"
#include "hlc_bridge/record/explanation_file.hpp"
#include "hlc_bridge/record/run_folder.hpp"
#include "planner/apps/fitted_table.hpp"
#include "planner/apps/flags.hpp"
#include "planner/apps/interruption.hpp"
#include "planner/common/text_file.hpp"
#include "planner/plot/search_page.hpp"
#include "planner/scenario/problem_dump.hpp"
#include "planner/scenario/scenario.hpp"
#include "planner/search/recorded_search.hpp"
#include "vehicle_sim/apps/explain_all.hpp"
#include "vehicle_sim/apps/explanation.hpp"
#include "vehicle_sim/apps/fork_folder.hpp"
#include "vehicle_sim/apps/step_answers.hpp"
#include "vehicle_sim/closed_loop/experiment.hpp"

namespace {

using hlc::VehicleId;
using Rows = std::vector<hlc::result::StepRecord>;

struct Choices {
  std::filesystem::path run;
  std::uint8_t vehicle{};
  std::uint64_t step{};
  bool all{};
  bool tree{};
  std::filesystem::path problems;
};

/// The report of the vehicle in the step; nullptr: there is none.
const hlc::coordination::Report* report_of(const Rows& rows, const Choices& choices) {
  const auto found = std::ranges::find_if(rows, [&](const hlc::result::StepRecord& row) {
    return row.step == choices.step && row.record.report.vehicle.value == choices.vehicle;
  });
  return found == rows.end() ? nullptr : &found->record.report;
}

/// What the controller searched last in the step, as a page; empty: it searched nothing.
std::string search_page_of(const hlc::controller::Controller& controller,
                           const std::filesystem::path& automaton_file) {
  if (controller.problems().empty()) return {};
  const hlc::controller::SearchedProblem& searched = controller.problems().back();
  hlc::scenario::ProblemFile file{.automaton_file = automaton_file,
                                  .subgraph = searched.subgraph,
                                  .problem = searched.problem,
                                  .search = controller.options().search};
  file.search.max_expansions = std::max<std::size_t>(searched.max_expansions, 1);
  const hlc::automaton::ReachableSets reachable(*file.subgraph, file.problem.horizon_steps());
  return hlc::plot::search_page(
      file, hlc::search::record_search(*file.subgraph, reachable, file.search, file.problem));
}

struct Driven {
  Rows rows;
  hlc::apps::StepOutcome outcome;  ///< of the vehicle in the step
  hlc::apps::StepAnswers answers;
  std::string search_page;  ///< if wanted
};

/// Drives the run up to the step, and with some vehicles gone from the step on.
class Drives {
 public:
  Drives(const hlc::record::RunFolder& run, const Choices& choices)
      : run_(run), choices_(choices), options_(hlc::apps::options_of_run(run)) {
    options_.steps = choices.step + 1;
    options_.prepared = hlc::scenario::prepare_subgraph_of(run.scenario);
    std::erase_if(options_.forks,
                  [&](const hlc::closed_loop::Fork& fork) { return fork.from > choices.step; });
  }

  /// @param dump  receives the planning problems; may be nullptr
  [[nodiscard]] Driven as_it_was(hlc::scenario::ProblemDump* dump) const {
    hlc::apps::StepAnswers answers;
    std::string search_page;
    Driven driven = drive(options_, [&](const hlc::controller::Controller& controller,
                                        const hlc::policy::SubgraphSelector& chosen,
                                        const hlc::coordination::Report& report) {
      if (dump != nullptr) dump->write(controller);
      if (choices_.tree) search_page = search_page_of(controller, run_.scenario.automaton_file);
      answers = hlc::apps::answers_of(controller, chosen, report, run_.scenario.policy);
    });
    driven.answers = std::move(answers);
    driven.search_page = std::move(search_page);
    return driven;
  }

  [[nodiscard]] hlc::apps::ExplainedStep::Without without(std::vector<VehicleId> gone) const {
    hlc::closed_loop::ExperimentOptions options = options_;
    hlc::closed_loop::Fork fork{.from = choices_.step, .changes = {}};
    for (const VehicleId one : gone)
      fork.changes.emplace_back(hlc::closed_loop::Fork::Without{one});
    options.forks.push_back(std::move(fork));
    return {.gone = std::move(gone),
            .outcome = drive(std::move(options), [](const auto&...) {}).outcome};
  }

 private:
  /// @param look  at the vehicle's controller after the step
  [[nodiscard]] Driven drive(hlc::closed_loop::ExperimentOptions options,
                             const hlc::closed_loop::ExperimentOptions::AfterStep& look) const {
    Driven driven;
    options.after_step = [&](const hlc::controller::Controller& controller,
                             const hlc::policy::SubgraphSelector& chosen,
                             const hlc::coordination::Report& report) {
      const std::uint64_t step = controller.last_step().value - *run_.facts.first_step;
      if (step != choices_.step || controller.options().vehicle.value != choices_.vehicle) return;
      driven.outcome.ahead_m = hlc::apps::ahead_m(controller);
      look(controller, chosen, report);
    };
    const hlc::closed_loop::Experiment experiment =
        hlc::closed_loop::drive_experiment(run_.scenario, options);
    driven.rows =
        hlc::result::step_records(experiment.reports, experiment.drives, experiment.facts);
    if (const auto* const report = report_of(driven.rows, choices_)) {
      driven.outcome.report = *report;
    }
    return driven;
  }

  const hlc::record::RunFolder& run_;
  const Choices& choices_;
  hlc::closed_loop::ExperimentOptions options_;
};

void check_choices(const hlc::record::RunFolder& run, const Choices& choices) {
  const std::vector<std::uint8_t>& ids = run.facts.vehicle_ids;
  if (std::ranges::find(ids, choices.vehicle) == ids.end()) {
    throw std::invalid_argument(
        fmt::format("--vehicle_id = {}, must be one of {}", choices.vehicle, fmt::join(ids, ", ")));
  }
  if (report_of(run.rows, choices) != nullptr) return;
  throw std::invalid_argument(
      fmt::format("--step = {}, must be one with a report of vehicle {}; the run's last is {}",
                  choices.step, choices.vehicle, run.rows.empty() ? 0 : run.rows.back().step));
}

/// Those that may have changed the step: coupled, missing, waited for, or in the way of the plan.
std::vector<VehicleId> that_may_matter(const hlc::coordination::Report& report,
                                       const std::vector<VehicleId>& others) {
  std::set<VehicleId> found(report.coupled.begin(), report.coupled.end());
  found.insert(report.missing.begin(), report.missing.end());
  found.insert(report.blocked_by.begin(), report.blocked_by.end());
  found.insert(report.waiting.vehicles.begin(), report.waiting.vehicles.end());
  std::erase_if(found, [&](VehicleId one) { return std::ranges::count(others, one) == 0; });
  return {found.begin(), found.end()};
}

/// The page as a file of its own and within the run's page. @return exit code
int keep_search_page(hlc::record::RunFolder run, const Choices& choices,
                     const std::string& search_page) {
  if (search_page.empty()) {
    std::cerr << fmt::format("explain: --tree: vehicle {} searched nothing in step {}\n",
                             choices.vehicle, choices.step);
    return hlc::kExitBadInput;
  }
  const std::filesystem::path file =
      hlc::record::search_page_file(run.folder, hlc::VehicleId{choices.vehicle}, choices.step);
  const std::filesystem::path page = hlc::apps::page_file(run.folder);
  std::error_code error;
  std::filesystem::create_directories(file.parent_path(), error);
  if (error) {
    throw std::runtime_error(file.parent_path().string() +
                             ": cannot be created: " + error.message());
  }
  hlc::write_file(file, search_page);
  hlc::apps::write_page(std::move(run));
  std::cout << fmt::format("\nwhat was searched: {}\nthe run as a page, with it: {}\n",
                           file.string(), page.string());
  return hlc::kExitGood;
}

/// Before anything is driven or written.
void check_can_be_recorded(const hlc::record::RunFolder& run) {
  try {
    hlc::search::check_can_be_recorded(run.scenario.search);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(fmt::format("{}: {}", run.folder.string(), error.what()));
  }
}

int explain_step(hlc::record::RunFolder run, const Choices& choices) {
  check_choices(run, choices);
  if (choices.tree) check_can_be_recorded(run);
  const Drives drives(run, choices);
  std::optional<hlc::scenario::ProblemDump> dump;
  if (!choices.problems.empty()) {
    dump.emplace(choices.problems, run.scenario.automaton_file, run.scenario.subgraph->spec());
  }
  const Driven driven = drives.as_it_was(dump ? &*dump : nullptr);
  hlc::apps::check_same_until(choices.step + 1, run, driven.rows);
  const hlc::coordination::Report& report = driven.outcome.report;
  hlc::apps::ExplainedStep explained =
      hlc::apps::explained_step(run, choices.step, driven.outcome, driven.answers);
  const std::vector<VehicleId> may_matter = that_may_matter(report, explained.others);
  if (choices.step > 0 && !may_matter.empty()) {
    explained.without_all = drives.without(may_matter);
    for (const VehicleId one : may_matter) explained.without_one.push_back(drives.without({one}));
  }
  std::cout << hlc::apps::fitted_lines(hlc::apps::explanation(explained));
  return choices.tree ? keep_search_page(std::move(run), choices, driven.search_page)
                      : hlc::kExitGood;
}

int explain(const Choices& choices) {
  hlc::record::RunFolder run = hlc::record::read_run_folder(choices.run);
  for (const std::string& line : run.incomplete) {
    std::cerr << "explain: " << choices.run.string() << ": " << line << '\n';
  }
  if (!choices.all) return explain_step(std::move(run), choices);
  const hlc::apps::Interruption interruption(
      "explain", "nothing is written yet: the same command begins from the start");
  const std::size_t count = hlc::apps::explain_all(std::move(run));
  const char* const why_none =
      count > 0 ? "" : " (no vehicle waited, kept its plan, missed others or braked to a stand)";
  std::cout << fmt::format("{} steps explained{}: {}\nthe run as a page: {}\n", count, why_none,
                           hlc::record::explanations_file(choices.run).string(),
                           hlc::apps::page_file(choices.run).string());
  return hlc::kExitGood;
}

}  // namespace

int main(int argc, char** argv) {
  hlc::apps::CommandLine app{
      "Why a vehicle did what it did in a step of a run of logical time: what it knew, what it "
      "would have done alone, without each of the others, and without each limit of its plan: the "
      "lane boundary, the end of its right of way, a zone, a request. Each answer without others "
      "is the run driven again up to this step, without them from there on; each without a limit "
      "is the step's problem searched again.",
      "explain"};
  Choices choices;
  hlc::apps::declare_run(app, choices.run);
  CLI::Option* const vehicle =
      app.add_option("--vehicle_id", choices.vehicle, "required without --all")
          ->check(hlc::apps::whole(1, hlc::kMaxVehicleId));
  CLI::Option* const step =
      app.add_option("--step", choices.step,
                     "from 0, as on the page and in steps.csv; required without --all")
          ->check(hlc::apps::whole(0, 100000));
  CLI::Option* const all = app.add_flag(
      "--all", choices.all,
      "instead: explains every step in which a vehicle begins to keep its plan, to wait or to "
      "miss others, or brakes to a stand, by searches alone (the run is driven once; some seconds "
      "for 20 cars and 150 steps), writes explanations.csv into the run folder and its run.html "
      "again with them");
  CLI::Option* const problems =
      app.add_option("--dump_problems", choices.problems,
                     "folder for the step's planning problems, for plan_problem; default: none");
  problems->type_name("DIR");
  CLI::Option* const tree = app.add_flag(
      "--tree", choices.tree,
      "also shows what was searched in the step, vertex by vertex: searches it again with the "
      "plain engine and writes searches/vehicle_N_step_K.html into the run folder, and its "
      "run.html again with it");
  all->excludes(vehicle)->excludes(step)->excludes(problems)->excludes(tree);
  hlc::apps::declare_help_end(
      app, {.examples = {"explain runs/my_run --vehicle_id 3 --step 57 --tree",
                         "explain runs/my_run --all"},
            .exit_codes =
                "0 success, 2 invalid input or an output that cannot be written, 130 interrupted"});
  if (const auto code = hlc::apps::parse_flags(
          app, argc, argv, {{"--vehicle", "--vehicle_id"}, {"--problems", "--dump_problems"}})) {
    return *code;
  }
  if (!choices.all && (vehicle->empty() || step->empty())) {
    std::cerr << "explain: --vehicle_id and --step must be given, or --all\n";
    return hlc::kExitBadInput;
  }
  return hlc::apps::exit_code_of("explain", [&] { return explain(choices); });
}
