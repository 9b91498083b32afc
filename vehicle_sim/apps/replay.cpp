// Drives a run again, in one process: the same, or, in logical time, with something changed from a
// step on.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "hlc_bridge/messages/exit_codes.hpp"
#include "hlc_bridge/record/configuration.hpp"
#include "hlc_bridge/record/program.hpp"
#include "hlc_bridge/record/report_file.hpp"
#include "hlc_bridge/record/run_folder.hpp"
#include "hlc_bridge/result/first_difference.hpp"
#include "hlc_bridge/result/run_summary.hpp"
#include "hlc_bridge/result/summary_table.hpp"
#include "hlc_bridge/result/trace_hash.hpp"
#include "planner/apps/fitted_table.hpp"
#include "planner/apps/flags.hpp"
#include "planner/common/program_version.hpp"
#include "planner/scenario/scenario.hpp"
#include "vehicle_sim/apps/clocks.hpp"
#include "vehicle_sim/apps/fork_folder.hpp"
#include "vehicle_sim/apps/recorded_messages.hpp"
#include "vehicle_sim/closed_loop/experiment.hpp"

namespace {

constexpr int kExitDiffers = 1;

struct Choices {
  std::filesystem::path run;
  std::optional<std::uint64_t> until;
  std::optional<std::uint64_t> from;
  std::vector<std::string> set;
  std::filesystem::path out;
};

using Rows = std::vector<hlc::result::StepRecord>;

void drove(std::uint64_t steps, std::size_t vehicles, double run_s, double wall_s) {
  std::cout << fmt::format("drove {} steps of {} vehicles in {:.2f} s ({:.0f} times real time)\n",
                           steps, vehicles, wall_s, run_s / wall_s);
}

int compare_with(const hlc::record::RunFolder& recorded, const Rows& rows, std::uint64_t steps) {
  const std::uint64_t until = std::min(steps, hlc::record::recorded_steps(recorded));
  const auto expected = hlc::result::rows_before(recorded.rows, until);
  const auto driven = hlc::result::rows_before(rows, until);
  const std::string& ended = recorded.facts.reason;
  if (until < steps) {
    std::cout << fmt::format("{} of {} steps are recorded: {}\n", until, steps,
                             ended.empty() ? "reports.csv ends early" : ended);
  }
  const auto difference = hlc::result::first_difference(expected, driven);
  if (!difference) {
    std::cout << "bitwise identical: trace_sha256 " << hlc::result::trace_sha256(driven) << '\n';
    return until < steps && ended.empty() ? kExitDiffers : hlc::kExitGood;
  }
  std::cout << "differs (record and replay) first at "
            << hlc::result::text_of(*difference, recorded.description.step_s) << '\n'
            << "trace_sha256: recorded " << hlc::result::trace_sha256(expected) << ", replayed "
            << hlc::result::trace_sha256(driven) << '\n';
  return kExitDiffers;
}

/// Priorities alone may change nothing: who enters a zone first is not up to them.
std::string why_unchanged(const hlc::record::RunFolder& recorded, const Choices& choices,
                          bool is_changed) {
  const bool are_priorities = std::ranges::any_of(
      choices.set, [](const std::string& text) { return text.starts_with("priorities="); });
  if (is_changed || !are_priorities || !recorded.scenario.conflicts) return "";
  return "with right of way, who enters a conflict zone first does not depend on priorities\n";
}

void describe_fork(const hlc::record::RunFolder& recorded, const Choices& choices,
                   const hlc::closed_loop::Experiment& experiment, const Rows& rows,
                   std::uint64_t steps) {
  std::cout << fmt::format(
      "from step {} on: {}\n", *choices.from,
      choices.set.empty() ? "nothing changed" : fmt::format("{}", fmt::join(choices.set, ", ")));
  const std::uint64_t until = std::min(steps, hlc::record::recorded_steps(recorded));
  const auto run_rows = hlc::result::rows_before(recorded.rows, until);
  const auto fork_rows = hlc::result::rows_before(rows, until);
  const auto difference = hlc::result::first_difference(run_rows, fork_rows);
  if (difference) {
    std::cout << "parts (run and fork) at "
              << hlc::result::text_of(*difference, recorded.description.step_s) << '\n';
    const hlc::result::WayDifference ways = hlc::result::way_difference(run_rows, fork_rows);
    std::cout << hlc::result::text_of(ways, recorded.description.step_s) << '\n'
              << why_unchanged(recorded, choices, ways.first.has_value()) << '\n';
  } else {
    std::cout << "the fork is the same as the run: trace_sha256 "
              << hlc::result::trace_sha256(fork_rows) << "\n\n";
  }
  hlc::result::RunDescription description = recorded.description;
  const hlc::record::KeptFork fork{.from = *choices.from, .set = choices.set};
  hlc::record::omit_changed_routes({&fork, 1}, description);
  hlc::record::add_obstacles({&fork, 1}, description);
  hlc::result::RunSummary summary =
      hlc::result::summarize(description, experiment.facts, rows, experiment.drives);
  summary.revision = hlc::program_revision();
  summary.host = hlc::record::this_host();
  std::cout << hlc::apps::fitted_table(hlc::result::summary_table(summary));
}

/// Of one vehicle, also those before the start; the last one of a step counts.
std::vector<hlc::ReportRecord> reports_of(hlc::VehicleId vehicle,
                                          const std::vector<hlc::ReportRecord>& reports) {
  std::map<hlc::StepIndex, hlc::ReportRecord> by_step;
  for (const hlc::ReportRecord& one : reports) {
    if (one.report.vehicle == vehicle) by_step.insert_or_assign(one.report.step, one);
  }
  std::vector<hlc::ReportRecord> found;
  for (auto& [step, one] : by_step) found.push_back(std::move(one));
  return found;
}

/// @return whether the controller's steps are the same again
bool is_same_again(const hlc::record::RunFolder& recorded, std::uint64_t until,
                   const std::vector<hlc::ReportRecord>& before,
                   const std::vector<hlc::ReportRecord>& again) {
  const auto rows_of = [&](const std::vector<hlc::ReportRecord>& reports) {
    const Rows all = hlc::result::step_records(reports, recorded.drives, recorded.facts);
    const auto some = hlc::result::rows_before(all, until);
    return Rows(some.begin(), some.end());
  };
  const int vehicle = before.front().report.vehicle.value;
  const Rows expected = rows_of(before);
  const Rows driven = rows_of(again);
  const auto difference =
      hlc::result::first_difference(std::span(expected).first(driven.size()), driven);
  if (difference) {
    std::cout << "differs (record and replay) first at "
              << hlc::result::text_of(*difference, recorded.description.step_s) << '\n';
  } else if (driven.size() < expected.size()) {
    std::cout << fmt::format("vehicle {}: the same up to step {}, whose list is not recorded\n",
                             vehicle, expected[driven.size()].step);
  } else {
    std::cout << fmt::format("vehicle {}: all {} steps are the same\n", vehicle, driven.size());
  }
  return !difference && driven.size() == expected.size();
}

/// Of a run in real time: each controller by itself, on what was recorded.
int replay_messages(const hlc::record::RunFolder& recorded, const Choices& choices) {
  if (choices.from) {
    throw std::invalid_argument("--from_step: " + choices.run.string() +
                                " was driven in real time, must be a run in logical time");
  }
  const hlc::closed_loop::RecordedMessages messages = hlc::apps::read_recorded_messages(recorded);
  const std::vector<hlc::ReportRecord> reports =
      hlc::record::read_reports(recorded.folder / "reports.csv");
  const hlc::controller::PreparedSubgraph prepared =
      hlc::scenario::prepare_subgraph_of(recorded.scenario);
  const std::uint64_t until = choices.until.value_or(std::numeric_limits<std::uint64_t>::max());
  bool is_same = true;
  for (const std::uint8_t id : recorded.facts.vehicle_ids) {
    const std::vector<hlc::ReportRecord> before = reports_of(hlc::VehicleId{id}, reports);
    if (before.empty()) continue;
    const std::vector<hlc::ReportRecord> again = hlc::closed_loop::drive_recorded(
        recorded.scenario, prepared, hlc::VehicleId{id}, messages, before);
    is_same = is_same_again(recorded, until, before, again) && is_same;
  }
  return is_same ? hlc::kExitGood : kExitDiffers;
}

int replay(const Choices& choices) {
  const hlc::record::RunFolder recorded = hlc::record::read_run_folder(choices.run);
  if (!recorded.facts.simulated_time) return replay_messages(recorded, choices);
  hlc::closed_loop::ExperimentOptions options = hlc::apps::options_of_run(recorded);
  if (recorded.rows.empty()) {
    throw std::invalid_argument(choices.run.string() + ": no step is recorded");
  }
  options.clocks = hlc::apps::machine_clocks();
  if (choices.until) options.steps = std::min(options.steps, *choices.until);
  std::erase_if(options.forks, [&](const hlc::closed_loop::Fork& fork) {
    return fork.from >= options.steps;  // of a run that is forked again, and ends earlier
  });
  std::filesystem::path folder;
  if (choices.from) {
    hlc::closed_loop::Fork fork{.from = *choices.from, .changes = {}};
    for (const std::string& text : choices.set) {
      fork.changes.push_back(hlc::closed_loop::change_from_text(text, recorded.scenario));
    }
    options.forks.push_back(fork);
    hlc::closed_loop::check_forks(options.forks, recorded.scenario, options.steps);
    folder = hlc::apps::fork_folder(recorded, *choices.from, choices.out);
  }
  const hlc::closed_loop::Experiment experiment =
      hlc::closed_loop::drive_experiment(recorded.scenario, options);
  const Rows rows =
      hlc::result::step_records(experiment.reports, experiment.drives, experiment.facts);
  drove(options.steps, recorded.scenario.vehicles.size(),
        recorded.description.step_s * static_cast<double>(options.steps), experiment.facts.wall_s);
  if (!choices.from) return compare_with(recorded, rows, options.steps);
  hlc::apps::check_same_until(*choices.from, recorded, rows);
  hlc::apps::write_fork(folder, recorded, *choices.from, choices.set, experiment);
  describe_fork(recorded, choices, experiment, rows, options.steps);
  std::cout << fmt::format(
      "\nrun folder: {0}\nits page: summarize --run {0}\nside by side: compare {1} {0}\n",
      folder.string(), choices.run.string());
  return hlc::kExitGood;
}

}  // namespace

int main(int argc, char** argv) {
  hlc::apps::CommandLine app{
      "Drives a run again in one process. In logical time the same run must give the same "
      "trace_sha256; with --from_step and --set it is a \"what if\" with a run folder of its own. "
      "In "
      "real time every controller plans again on the messages in run.mcap.",
      "replay"};
  Choices choices;
  hlc::apps::declare_run(app, choices.run);
  app.add_option("--until_step", choices.until, "only the steps before this one; default: all")
      ->check(hlc::apps::whole(1, 100000));
  CLI::Option* const from =
      app.add_option("--from_step", choices.from,
                     "from which something is different; from 0; default: nothing is")
          ->check(hlc::apps::whole(0, 100000));
  app.add_option(
         "--set", choices.set,
         std::string("what is different then, default: nothing; may be given several times:\n") +
             hlc::closed_loop::kChangeForms)
      ->needs(from)
      ->allow_extra_args(false);
  app.add_option("--out", choices.out,
                 "folder of the fork, new or empty; default: the run's name with _from_STEP")
      ->needs(from)
      ->type_name("DIR");
  hlc::apps::declare_help_end(
      app,
      {.examples = {"replay runs/my_run", "replay runs/my_run --from_step 40 --set priorities=2"},
       .exit_codes = "0 the same run, or a fork was driven, 1 the replay differs from the record, "
                     "or the record ends early without a reason, 2 invalid input or an output that "
                     "cannot be written",
       .notes = "The second example: what if car 2 had gone first?"});
  if (const auto code = hlc::apps::parse_flags(
          app, argc, argv, {{"--from", "--from_step"}, {"--until", "--until_step"}})) {
    return *code;
  }
  return hlc::apps::exit_code_of("replay", [&] { return replay(choices); });
}
