// Drives whole runs in memory under faults (dead and frozen processes, lost messages, clock errors)
// and checks the invariants that must hold under any fault.
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "planner/apps/flags.hpp"
#include "planner/apps/parallel.hpp"
#include "vehicle_sim/closed_loop/fault_campaign.hpp"

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
  std::vector<std::string> faults;
  std::uint64_t runs{100};
  std::uint64_t seed{1};
  std::size_t jobs{std::max(1U, std::thread::hardware_concurrency())};
  std::optional<std::uint64_t> replay;
  std::optional<std::vector<std::size_t>> keep;  ///< of the faults
  std::filesystem::path trace;
};

std::vector<std::string> fault_names() {
  std::vector<std::string> names;
  for (const FaultKind kind : hlc::closed_loop::all_fault_kinds()) {
    names.emplace_back(to_string(kind));
  }
  return names;
}

/// "1 h 02 min", "3 min 10 s", "12 s".
std::string duration_text(double seconds) {
  const auto whole = static_cast<long long>(seconds + 0.5);
  char text[64];
  if (whole >= 3600) {
    std::snprintf(text, sizeof text, "%lld h %02lld min", whole / 3600, whole % 3600 / 60);
  } else if (whole >= 60) {
    std::snprintf(text, sizeof text, "%lld min %02lld s", whole / 60, whole % 60);
  } else {
    std::snprintf(text, sizeof text, "%lld s", whole);
  }
  return text;
}

/// On a terminal a single updated line, with the remaining time.
class Progress {
 public:
  explicit Progress(std::uint64_t runs) : runs_(runs) {}
  ~Progress() {
    if (is_shown_) std::fprintf(stderr, "\r\033[K");
  }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void show(std::uint64_t done, std::uint64_t failed) const {
    if (!is_shown_) return;
    const double passed_s = std::chrono::duration<double>(Clock::now() - begin_).count();
    const double left_s = passed_s / static_cast<double>(done) * static_cast<double>(runs_ - done);
    std::fprintf(stderr, "\r\033[Krun %llu of %llu, %llu failed, %s left",
                 static_cast<unsigned long long>(done), static_cast<unsigned long long>(runs_),
                 static_cast<unsigned long long>(failed), duration_text(left_s).c_str());
  }

 private:
  std::uint64_t runs_;
  bool is_shown_{isatty(STDERR_FILENO) == 1};
  Clock::time_point begin_{Clock::now()};
};

void print_violations(const FaultRunResult& result) {
  for (const auto& violation : result.violations) {
    std::printf("  %9.3f s  %s: %s\n", 1e-9 * static_cast<double>(violation.at),
                violation.check.c_str(), violation.text.c_str());
  }
}

int replay(const Choices& choices) {
  const FaultCampaign campaign(choices.campaign);
  const hlc::closed_loop::FaultCase the_case =
      choices.keep ? campaign.draw(*choices.replay, *choices.keep) : campaign.draw(*choices.replay);
  std::ofstream file;
  if (!choices.trace.empty()) {
    file.open(choices.trace);
    if (!file) {
      throw std::invalid_argument("--trace = " + choices.trace.string() +
                                  ", must be a file that can be written");
    }
  }
  std::printf("%s", describe(the_case).c_str());
  const FaultRunResult result =
      campaign.run(the_case, [&](hlc::Nanoseconds at, const std::string& line) {
        if (!file.is_open()) return;
        char time[32];
        std::snprintf(time, sizeof time, "%12.6f ", 1e-9 * static_cast<double>(at));
        file << time << line << '\n';
      });
  print_violations(result);
  if (file.is_open() && !file.flush()) {
    throw std::runtime_error(choices.trace.string() + ": cannot be written");
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
  std::string keep;
  for (const std::size_t index : shrunk.kept) {
    keep += (keep.empty() ? " --keep " : ",") + std::to_string(index);
  }
  if (shrunk.kept.empty()) keep = " --keep none";
  std::printf("  again: fault_simulator%s --replay %llu%s --trace trace.txt\n", flags.c_str(),
              static_cast<unsigned long long>(seed), keep.c_str());
}

thread_local std::uint64_t seed_at_work = 0;

/// An assertion of the code under test failed, in the thread that runs this seed.
void report_abort(int /*signal*/) {
  char text[64];
  const int size = std::snprintf(text, sizeof text, "seed %llu fails: abort: --replay it\n",
                                 static_cast<unsigned long long>(seed_at_work));
  if (write(STDOUT_FILENO, text, static_cast<std::size_t>(size)) < 0) return;
}

int campaign(const Choices& choices, const std::string& flags) {
  static_cast<void>(std::signal(SIGABRT, report_abort));
  const FaultCampaign campaign(choices.campaign);
  hlc::closed_loop::FaultTotals totals;
  std::vector<std::uint64_t> failed;
  std::mutex mutex;
  const Clock::time_point begin = Clock::now();
  {
    const Progress progress(choices.runs);
    hlc::apps::run_parallel(
        choices.runs, choices.jobs,
        [&](std::size_t i) {
          const std::uint64_t seed = choices.seed + i;
          seed_at_work = seed;
          FaultRunResult result = campaign.run(campaign.draw(seed));
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
          progress.show(done, failed.size());
        });
  }
  const double wall_s = std::chrono::duration<double>(Clock::now() - begin).count();
  std::ranges::sort(failed);
  for (std::size_t i = 0; i < std::min<std::size_t>(failed.size(), 10); ++i) {
    print_failure(campaign, failed[i], flags);
  }
  if (failed.size() > 10) {
    std::printf("and %zu more seeds fail:", failed.size() - 10);
    for (std::size_t i = 10; i < failed.size(); ++i) {
      std::printf(" %llu", static_cast<unsigned long long>(failed[i]));
    }
    std::printf("\n");
  }
  std::printf("%s, %.1f s, %.0f car-steps a minute\n", describe(totals).c_str(), wall_s,
              60.0 * static_cast<double>(totals.car_steps) / std::max(wall_s, 1e-9));
  return failed.empty() ? 0 : 1;
}

/// The flags to repeat before --replay for the same runs.
std::string flags_of(const Choices& choices) {
  std::string flags = " --cars " + std::to_string(choices.campaign.cars);
  if (!choices.faults.empty()) {
    flags += " --faults ";
    for (const std::string& fault : choices.faults) {
      flags += (&fault == choices.faults.data() ? "" : ",") + fault;
    }
  }
  return flags;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Runs in memory with faults that a seed draws, judged in every tick.",
               "fault_simulator");
  app.footer("Exit codes: 0 nothing is violated, 1 something is, 2 bad flags or files.");
  Choices choices;
  std::vector<std::string> keep;
  choices.campaign.scenario_folder = "launch_scripts/scenarios";
  app.add_option("--cars", choices.campaign.cars, "3 ... 8; 0: as the seed has it")
      ->check(hlc::apps::whole(0, 8))
      ->capture_default_str();
  app.add_option("--runs", choices.runs, "number of runs")
      ->check(hlc::apps::whole(1, kLargestSeed))
      ->capture_default_str();
  app.add_option("--seed", choices.seed, "of the first run; the next ones count on")
      ->check(hlc::apps::whole(0, kLargestSeed))
      ->capture_default_str();
  app.add_option("--faults", choices.faults, "kinds of faults (default: all)")
      ->delimiter(',')
      ->check(hlc::apps::among(fault_names()));
  app.add_option("--jobs", choices.jobs, "threads (default: as many as cores)")
      ->check(hlc::apps::whole(1, 256));
  app.add_option("--scenario_folder", choices.campaign.scenario_folder, "folder of the scenarios")
      ->capture_default_str();
  app.add_option("--replay", choices.replay, "only the run of this seed")
      ->check(hlc::apps::whole(0, kLargestSeed));
  app.add_option("--keep", keep, "with --replay: only these of its faults, from 0; or none")
      ->delimiter(',');
  app.add_option("--trace", choices.trace, "with --replay: file for what happens");
  if (const std::optional<int> code = hlc::apps::parse_flags(app, argc, argv)) return *code;
  return hlc::apps::exit_code_of("fault_simulator", [&] {
    hlc::apps::check_each_once("--faults", choices.faults);
    if (!choices.replay && (!keep.empty() || !choices.trace.empty())) {
      throw std::invalid_argument("--keep and --trace require --replay");
    }
    if (choices.campaign.cars == 1 || choices.campaign.cars == 2) {
      throw std::invalid_argument("--cars = " + std::to_string(choices.campaign.cars) +
                                  ", must be 0 or 3 ... 8");
    }
    choices.campaign.kinds = hlc::closed_loop::fault_kinds_of(choices.faults);
    if (!keep.empty()) choices.keep.emplace();
    for (const std::string& index : keep) {
      if (index == "none" && keep.size() == 1) break;
      if (index.empty() || index.size() > 4 ||
          !std::ranges::all_of(index, [](char c) { return c >= '0' && c <= '9'; })) {
        throw std::invalid_argument("--keep = " + index + ", must be numbers of faults or none");
      }
      choices.keep->push_back(std::stoul(index));
    }
    return choices.replay ? replay(choices) : campaign(choices, flags_of(choices));
  });
}
