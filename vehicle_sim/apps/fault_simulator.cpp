// Drives whole runs in memory under faults (dead and frozen processes, lost messages, clock errors)
// and checks the invariants that must hold under any fault.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

#include "planner/apps/flags.hpp"
#include "planner/apps/interruption.hpp"
#include "planner/apps/parallel.hpp"
#include "planner/apps/progress_line.hpp"
#include "planner/apps/scenario_name.hpp"
#include "planner/coordination/priorities/strategies.hpp"
#include "vehicle_sim/closed_loop/fault_campaign.hpp"
#include "vehicle_sim/run_folder/run_folder.hpp"

namespace {

using hlc::closed_loop::FaultCampaign;
using hlc::closed_loop::FaultCampaignSettings;
using hlc::closed_loop::FaultKind;
using hlc::closed_loop::FaultRunResult;
using Clock = std::chrono::steady_clock;

constexpr std::uint64_t kTwice = 50;
constexpr std::uint64_t kLargestSeed = 1'000'000'000'000;

struct Choices {
  FaultCampaignSettings campaign;
  std::string priorities{hlc::coordination::kConstantPriorities.name};
  std::vector<std::string> faults;
  std::uint64_t runs{100};
  std::uint64_t seed{1};
  std::size_t jobs{std::max(1U, std::thread::hardware_concurrency())};
  std::optional<std::uint64_t> replay;
  std::optional<std::vector<std::size_t>> keep;  ///< of the faults
  std::filesystem::path trace;
  std::filesystem::path out;  ///< for the runs' records; empty: none
};

std::vector<std::string> fault_names() {
  std::vector<std::string> names;
  for (const FaultKind kind : hlc::closed_loop::all_fault_kinds()) {
    names.emplace_back(to_string(kind));
  }
  return names;
}

void print_violations(const FaultRunResult& result) {
  for (const auto& violation : result.violations) {
    std::printf("  %9.3f s  %s: %s\n", 1e-9 * static_cast<double>(violation.at),
                violation.check.c_str(), violation.text.c_str());
  }
}

void create_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (!error) return;
  throw std::invalid_argument("--out = " + folder.string() + ", must be a folder or a new one");
}

/// Of a run of `the_case`, into a folder of its own.
void write_records(const std::filesystem::path& out, const hlc::closed_loop::FaultCase& the_case,
                   const hlc::closed_loop::FaultRecords& records) {
  const std::filesystem::path folder = out / fmt::to_string(the_case.seed);
  create_folder(folder);
  const double step_s = the_case.scenario.subgraph->automaton().step_s;
  hlc::closed_loop::Experiment run{
      .facts = {.simulated_time = the_case.run.lab.is_logical,
                .period = static_cast<hlc::Nanoseconds>(std::llround(1e9 * step_s)),
                .first_step = hlc::result::first_step_of(records.reports)},
      .reports = records.reports,
      .drives = records.drives};
  for (const auto& vehicle : the_case.scenario.vehicles) {
    run.facts.vehicle_ids.push_back(vehicle.id.value);
  }
  hlc::run_folder::write_records(folder, run);
}

int replay(const Choices& choices) {
  const FaultCampaign campaign(choices.campaign);
  hlc::closed_loop::FaultCase the_case =
      choices.keep ? campaign.draw(*choices.replay, *choices.keep) : campaign.draw(*choices.replay);
  std::ofstream file;
  if (!choices.trace.empty()) {
    file.open(choices.trace);
    if (!file) {
      throw std::invalid_argument("--trace = " + choices.trace.string() +
                                  ", must be a file that can be written");
    }
  }
  the_case.run.keeps_records = !choices.out.empty();
  std::printf("%s", describe(the_case).c_str());
  const FaultRunResult result =
      campaign.run(the_case, [&](hlc::Nanoseconds at, const std::string& line) {
        if (!file.is_open()) return;
        file << fmt::format("{:12.6f} {}\n", 1e-9 * static_cast<double>(at), line);
      });
  print_violations(result);
  if (result.records) write_records(choices.out, the_case, *result.records);
  if (file.is_open() && !file.flush()) {
    throw std::invalid_argument("--trace = " + choices.trace.string() + ", cannot be written");
  }
  std::printf("hash %016llx, %llu car-steps, %zu violations\n",
              static_cast<unsigned long long>(result.hash),
              static_cast<unsigned long long>(result.car_steps), result.violations.size());
  return result.violations.empty() ? 0 : 1;
}

void print_failure(const FaultCampaign& campaign, std::uint64_t seed, const std::string& flags) {
  const hlc::closed_loop::Shrunk shrunk = campaign.shrink(seed);
  std::printf("seed %llu fails; with the fewest faults:\n%s", static_cast<unsigned long long>(seed),
              describe(shrunk.the_case).c_str());
  print_violations(shrunk.result);
  const std::string kept =
      shrunk.kept.empty() ? "none" : fmt::format("{}", fmt::join(shrunk.kept, ","));
  fmt::print("  again: fault_simulator{} --replay {} --keep {} --trace trace.txt\n", flags, seed,
             kept);
}

thread_local std::uint64_t seed_at_work = 0;

/// An assertion of the code under test failed, or it crashed, in the thread that runs this seed.
void report_abort(int signal) {
  static_cast<void>(std::signal(signal, SIG_DFL));
  char text[64];
  const int size = std::snprintf(text, sizeof text, "seed %llu fails: %s: --replay it\n",
                                 static_cast<unsigned long long>(seed_at_work),
                                 signal == SIGABRT ? "abort" : "crash");
  if (write(STDOUT_FILENO, text, static_cast<std::size_t>(size)) < 0) return;
}

int campaign(const Choices& choices, const std::string& flags) {
  static_cast<void>(std::signal(SIGABRT, report_abort));
  static_cast<void>(std::signal(SIGSEGV, report_abort));
  const FaultCampaign campaign(choices.campaign);
  hlc::closed_loop::FaultTotals totals;
  std::vector<std::uint64_t> failed;
  std::mutex mutex;
  const Clock::time_point begin = Clock::now();
  {
    const hlc::apps::Interruption interruption(
        "fault_simulator", "seeds that fail are printed above; --seed goes on from a later one");
    const hlc::apps::ProgressLine progress("run", choices.runs);
    hlc::apps::run_parallel(
        choices.runs, choices.jobs,
        [&](std::size_t i) {
          const std::uint64_t seed = choices.seed + i;
          seed_at_work = seed;
          hlc::closed_loop::FaultCase the_case = campaign.draw(seed);
          the_case.run.keeps_records = !choices.out.empty();
          FaultRunResult result = campaign.run(the_case);
          if (result.records) write_records(choices.out, the_case, *result.records);
          // Some seeds run twice: the same seed must give the same hash.
          if (i % kTwice == 0 && campaign.run(campaign.draw(seed)).hash != result.hash) {
            result.violations.push_back({.check = "hash", .text = "another hash in another run"});
          }
          const std::lock_guard lock(mutex);
          totals.add(result);
          if (result.violations.empty()) return;
          failed.push_back(seed);
          std::printf("seed %llu fails: %s: %s\n", static_cast<unsigned long long>(seed),
                      result.violations.front().check.c_str(),
                      result.violations.front().text.c_str());
          std::fflush(stdout);
        },
        [&](std::size_t done) {
          const std::lock_guard lock(mutex);
          progress.show(done, fmt::format(", {} failed", failed.size()));
        });
  }
  const double wall_s = std::chrono::duration<double>(Clock::now() - begin).count();
  std::ranges::sort(failed);
  for (std::size_t i = 0; i < std::min<std::size_t>(failed.size(), 10); ++i) {
    print_failure(campaign, failed[i], flags);
  }
  if (failed.size() > 10) {
    fmt::print("and {} more seeds fail: {}\n", failed.size() - 10,
               fmt::join(failed.begin() + 10, failed.end(), " "));
  }
  std::printf("%s, %.1f s, %.0f car-steps a minute\n", describe(totals).c_str(), wall_s,
              60.0 * static_cast<double>(totals.car_steps) / std::max(wall_s, 1e-9));
  return failed.empty() ? 0 : 1;
}

/// The flags to repeat before --replay for the same runs.
std::string flags_of(const Choices& choices) {
  const bool is_constant = choices.priorities == hlc::coordination::kConstantPriorities.name;
  return fmt::format(
      " --cars {}{}{}{}{}{}", choices.campaign.cars,
      choices.campaign.scenario.empty() ? "" : " --scenario " + choices.campaign.scenario.string(),
      choices.campaign.has_two_rounds ? " --two_rounds" : "",
      is_constant ? "" : " --priorities " + choices.priorities,
      choices.faults.empty() ? "" : " --faults ", fmt::join(choices.faults, ","));
}

/// What is driven in all runs.
void add_campaign_flags(CLI::App& app, Choices& choices) {
  app.add_option("--cars", choices.campaign.cars,
                 fmt::format("{} ... {}, with --scenario {}; 0: as the seed has it",
                             hlc::closed_loop::kFewestCars, hlc::closed_loop::kMostCars,
                             hlc::closed_loop::kMostDrawnCars))
      ->capture_default_str();
  hlc::apps::takes_scenario(
      app.add_option("--scenario", choices.campaign.scenario,
                     "of all runs, with the key draw, of which each run is another draw; default: "
                     "the circle and the paper's roads"));
  app.add_flag(
      "--two_rounds", choices.campaign.has_two_rounds,
      "cars compute each other's plans (rounds: two); in half of the runs one does not take "
      "part, plans by other rules or computes other bits");
  app.add_option("--priorities", choices.priorities, "who plans first, in all runs")
      ->check(hlc::apps::among(hlc::coordination::priority_strategy_names()))
      ->capture_default_str();
  app.add_option("--faults", choices.faults, "kinds of faults (default: all)")
      ->delimiter(',')
      ->check(hlc::apps::among(fault_names()));
  app.add_option("--scenario_folder", choices.campaign.scenario_folder,
                 "folder of the scenarios (default: scenarios beside the program)")
      ->type_name("DIR");
}

}  // namespace

int main(int argc, char** argv) {
  hlc::apps::CommandLine app("Runs in memory with faults that a seed draws, checked in every tick.",
                             "fault_simulator");
  hlc::apps::declare_help_end(
      app, {.examples = {"fault_simulator --cars 3 --runs 200 --seed 1",
                         "fault_simulator --cars 3 --replay 17 --trace trace.txt"},
            .exit_codes = "0 nothing is violated, 1 something is, 2 invalid input or an output "
                          "that cannot be written, 130 interrupted"});
  Choices choices;
  std::vector<std::string> keep;
  add_campaign_flags(app, choices);
  app.add_option("--runs", choices.runs, "number of runs")
      ->check(hlc::apps::whole(1, kLargestSeed))
      ->capture_default_str();
  app.add_option("--seed", choices.seed, "of the first run; the next ones count on")
      ->check(hlc::apps::whole(0, kLargestSeed))
      ->capture_default_str();
  app.add_option("--jobs", choices.jobs, "threads (default: as many as cores)")
      ->check(hlc::apps::whole(1, 256));
  CLI::Option* const replayed =
      app.add_option("--replay", choices.replay, "only the run of this seed; default: all runs")
          ->check(hlc::apps::whole(0, kLargestSeed));
  app.add_option("--keep", keep, "only these of its faults, from 0; or none; default: all")
      ->delimiter(',')
      ->needs(replayed)
      ->check(hlc::apps::whole(0, 9999) | hlc::apps::among({"none"}));
  app.add_option("--out", choices.out,
                 "folder for the records of every run, OUT/SEED, without the ticks in which a "
                 "vehicle is out of its controller's reach; for check_run.py; default: none")
      ->type_name("DIR");
  app.add_option("--trace", choices.trace, "file for what happens; default: none")
      ->needs(replayed)
      ->type_name("FILE");
  if (const std::optional<int> code = hlc::apps::parse_flags(app, argc, argv)) return *code;
  const auto run = [&] {
    hlc::apps::check_each_once("--faults", choices.faults);
    if (!choices.out.empty()) create_folder(choices.out);
    if (choices.campaign.scenario_folder.empty()) {
      choices.campaign.scenario_folder = hlc::apps::shipped_scenarios();
    }
    choices.campaign.priorities = hlc::coordination::priority_strategy(choices.priorities);
    choices.campaign.kinds = hlc::closed_loop::fault_kinds_of(choices.faults);
    if (!keep.empty()) choices.keep.emplace();
    for (const std::string& index : keep) {
      if (index != "none") choices.keep->push_back(std::stoul(index));
    }
    return choices.replay ? replay(choices) : campaign(choices, flags_of(choices));
  };
  return hlc::apps::exit_code_of("fault_simulator", run);
}
