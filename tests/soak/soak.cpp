// Many runs of three cars with real processes, one after the other: with random faults, started and
// stopped, or undisturbed in real time. See tests/soak/README.md.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <string>

#include "planner/apps/flags.hpp"
#include "tests/soak/soak_run.hpp"
#include "tests/support/own_shared_memory.hpp"
#include "tests/support/standstill_watch.hpp"

namespace {

using hlc::test::SoakResult;

struct Flags {
  std::size_t runs{};
  std::uint64_t seed{1};
  int faults_per_run{3};
  int steps{150};
  std::string transport{"loopback"};
  bool keep{};
};

struct Total {
  std::size_t runs{};
  std::size_t failed{};
  std::size_t faults{};
  std::size_t collisions{};
  std::size_t late{};
};

std::string millimetres(const SoakResult& result) {
  char text[32] = "-";
  if (result.min_distance_m) {
    std::snprintf(text, sizeof(text), "%.1f", 1e3 * *result.min_distance_m);
  }
  return text;
}

std::string exit_code(const SoakResult& result) {
  return result.lab_control ? std::to_string(*result.lab_control) : "-";
}

/// The verdict, and what was wrong in lines of its own.
void end_row(const SoakResult& result, Total& total) {
  std::printf("  %s\n", result.problems.empty() ? "good" : "FAILED");
  for (const std::string& problem : result.problems) std::printf("      %s\n", problem.c_str());
  if (result.standstill_s >= std::chrono::duration<double>(hlc::test::kStandstill).count()) {
    std::printf("      the machine stood still for %.1f s\n", result.standstill_s);
  }
  std::fflush(stdout);
  ++total.runs;
  total.failed += result.problems.empty() ? 0U : 1U;
  total.faults += result.faults_done;
  total.collisions += result.collisions;
  total.late += result.deadline_misses;
}

void check_faults(const Flags& flags, bool with_network, Total& total) {
  std::printf("%6s %6s %6s %9s  %s\n", "seed", "faults", "exit", "min [mm]", "what was struck");
  for (std::uint64_t seed = flags.seed; seed < flags.seed + flags.runs; ++seed) {
    const hlc::test::FaultPlan plan =
        hlc::test::plan_faults(seed, flags.faults_per_run, with_network);
    const SoakResult result = hlc::test::run_with_faults(plan, flags.transport, flags.keep);
    std::string what = plan.over_network ? "network: " : "";
    for (const hlc::test::PlannedFault& fault : plan.faults) {
      what += (&fault == &plan.faults.front() ? "" : ", ") + hlc::test::to_text(fault);
    }
    std::printf("%6llu %6zu %6s %9s  %s ", static_cast<unsigned long long>(seed),
                result.faults_done, exit_code(result).c_str(), millimetres(result).c_str(),
                what.c_str());
    end_row(result, total);
  }
  std::printf("%zu faults in %zu runs: %zu collisions, %zu runs failed\n", total.faults, total.runs,
              total.collisions, total.failed);
}

void check_cycles(const Flags& flags, Total& total) {
  std::printf("%6s %6s\n", "cycle", "exit");
  for (std::size_t i = 0; i < flags.runs; ++i) {
    const SoakResult result = hlc::test::run_cycle(i, flags.keep);
    std::printf("%6zu %6s ", i + 1, exit_code(result).c_str());
    end_row(result, total);
  }
  std::printf("%zu cycles, %zu failed\n", total.runs, total.failed);
}

void check_undisturbed_runs(const Flags& flags, Total& total) {
  std::printf("%6s %6s %9s %6s %9s %14s\n", "run", "exit", "min [mm]", "late", "fallbacks",
              "planning [ms]");
  for (std::size_t i = 0; i < flags.runs; ++i) {
    const SoakResult result = hlc::test::run_undisturbed(flags.steps, flags.transport, flags.keep);
    std::printf("%6zu %6s %9s %6zu %9zu %14.2f ", i + 1, exit_code(result).c_str(),
                millimetres(result).c_str(), result.deadline_misses, result.fallback_steps,
                1e3 * result.planning_max_s);
    end_row(result, total);
  }
  std::printf("%zu runs of %d steps: %zu late steps, %zu runs failed\n", total.runs, flags.steps,
              total.late, total.failed);
}

CLI::App* add(CLI::App& app, const char* name, const char* what, Flags& flags) {
  CLI::App* command = app.add_subcommand(name, what);
  command->add_option("--runs", flags.runs, "how many")
      ->check(hlc::apps::whole(1, 100'000))
      ->required();
  command->add_flag("--keep", flags.keep, "keep the folders of runs that were not good");
  return command;
}

}  // namespace

int main(int argc, char** argv) {
  hlc::apps::CommandLine app{
      "Drives three cars again and again and looks for what only shows now and then.", "soak"};
  Flags flags;
  CLI::App* faults =
      add(app, "faults", "random faults; a run's faults follow from its seed", flags);
  faults->add_option("--seed", flags.seed, "of the first run; the others count on")
      ->check(hlc::apps::whole(0, 1'000'000'000))
      ->capture_default_str();
  faults->add_option("--faults_per_run", flags.faults_per_run, "how many in each run")
      ->check(hlc::apps::whole(1, 20))
      ->capture_default_str();
  const CLI::App* cycles = add(app, "cycles", "start and stop, in logical and in real time", flags);
  CLI::App* undisturbed =
      add(app, "undisturbed", "whole runs in real time; late steps are counted", flags);
  undisturbed->add_option("--steps", flags.steps, "of each run")
      ->check(hlc::apps::whole(1, 100'000))
      ->capture_default_str();
  for (CLI::App* command : {faults, undisturbed}) {
    command
        ->add_option("--transport", flags.transport,
                     "loopback: the paper's cars; lab: as in the lab, with the lab's cars")
        ->check(CLI::IsMember({"loopback", "lab"}))
        ->capture_default_str();
  }
  app.require_subcommand(1);
  hlc::apps::declare_help_end(
      app, {.examples = {"soak faults --runs 100 --seed 1", "soak cycles"},
            .exit_codes = "0 every run passed, 1 a run failed, 2 invalid input",
            .notes = "Real processes on this machine. As root with an empty /dev/shm of its own, "
                     "in which nothing may be left, and with a network per car in some runs."});
  if (const auto code = hlc::apps::parse_flags(app, argc, argv)) return *code;
  const bool is_root = hlc::test::use_own_shared_memory();
  if (!is_root) std::printf("without root: leftovers in /dev/shm and the network are left out\n");
  Total total;
  if (faults->parsed()) {
    check_faults(flags, is_root, total);
  } else if (cycles->parsed()) {
    check_cycles(flags, total);
  } else {
    check_undisturbed_runs(flags, total);
  }
  return total.failed == 0 ? 0 : 1;
}
