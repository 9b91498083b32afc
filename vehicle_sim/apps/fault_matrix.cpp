// Drives runs in memory with one fault each, for every role, fault, phase and kind of run, and
// writes a table of what they come to.
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "planner/apps/flags.hpp"
#include "planner/apps/interruption.hpp"
#include "planner/apps/parallel.hpp"
#include "planner/apps/progress_line.hpp"
#include "planner/common/text_file.hpp"
#include "vehicle_sim/closed_loop/matrix_table.hpp"

namespace {

using hlc::closed_loop::CellResult;
using hlc::closed_loop::FaultMatrix;
using hlc::closed_loop::MatrixRun;
using hlc::closed_loop::MatrixVerdict;

constexpr std::uint64_t kMostRuns = 10'000;
constexpr std::uint64_t kLargestSeed = 1'000'000'000'000;
constexpr const char* kBegin = "<!-- fault_matrix -->\n";
constexpr const char* kEnd = "<!-- end of fault_matrix -->\n";

struct Choices {
  std::uint64_t runs{1};
  std::uint64_t seed{1};
  std::size_t jobs{std::max(1U, std::thread::hardware_concurrency())};
  std::string cells;  ///< text in the names of those that are run
  std::filesystem::path report;
  std::filesystem::path trace;
  std::filesystem::path scenario_folder;
};

/// A document with marks keeps what is outside of them.
void write_report(const std::filesystem::path& file, const std::string& report) {
  std::string text = report;
  if (std::filesystem::is_regular_file(file)) {
    std::ifstream stream(file);
    const std::string before{std::istreambuf_iterator<char>(stream), {}};
    const std::size_t begin = before.find(kBegin);
    const std::size_t end = before.find(kEnd);
    if (begin == std::string::npos || end == std::string::npos || end < begin) {
      throw std::invalid_argument("--table = " + file.string() +
                                  ", must be a new file or hold the marks of the table");
    }
    text = before.substr(0, begin) + kBegin + report + before.substr(end);
  }
  hlc::write_file(file, text);
}

std::vector<CellResult> cells_of(const std::string& text) {
  std::vector<CellResult> results;
  for (const auto& cell : hlc::closed_loop::matrix_cells()) {
    const bool is_chosen = to_string(cell).find(text) != std::string::npos;
    if (is_chosen && !not_run(cell)) results.push_back({.cell = cell});
  }
  if (results.empty()) {
    throw std::invalid_argument("--cells = " + text +
                                ", must be in the name of a cell that is run");
  }
  return results;
}

class Matrix {
 public:
  explicit Matrix(const Choices& choices)
      : choices_(choices), matrix_(choices.scenario_folder), results_(cells_of(choices.cells)) {}

  const std::vector<CellResult>& drive() {
    drive_undisturbed();
    const std::size_t count = results_.size() * choices_.runs;
    const hlc::apps::Interruption interruption(
        "fault_matrix",
        "no table is written yet: the same command begins from the start, --cells selects some");
    const hlc::apps::ProgressLine progress("run", count);
    hlc::apps::run_parallel(
        count, choices_.jobs,
        [this](std::size_t i) { drive(i / choices_.runs, choices_.seed + i % choices_.runs); },
        [&](std::size_t done) { progress.show(done, ""); });
    // In the order of seeds, however threads were scheduled.
    for (const auto& [place, verdict] : verdicts_) {
      results_[place.first].add(place.second, verdict);
    }
    return results_;
  }

 private:
  void drive_undisturbed() {
    const auto setups = hlc::closed_loop::matrix_setups();
    std::mutex mutex;
    hlc::apps::run_parallel(
        setups.size() * choices_.runs, choices_.jobs,
        [&](std::size_t i) {
          const std::uint64_t seed = choices_.seed + i / setups.size();
          const auto& setup = setups[i % setups.size()];
          MatrixRun run = matrix_.undisturbed(setup, seed);
          const std::lock_guard lock(mutex);
          undisturbed_.emplace(std::pair{to_string(setup), seed}, std::move(run));
        },
        [](std::size_t /*done*/) {});
  }

  void drive(std::size_t index, std::uint64_t seed) {
    const auto& cell = results_[index].cell;
    const MatrixRun& before = undisturbed_.at({to_string(cell.setup), seed});
    std::ofstream file;
    hlc::closed_loop::Trace trace;
    if (!choices_.trace.empty()) {
      file.open(choices_.trace);
      if (!file) {
        throw std::invalid_argument("--trace = " + choices_.trace.string() +
                                    ", must be a file that can be written");
      }
      trace = [&file](hlc::Nanoseconds at, const std::string& line) {
        file << fmt::format("{:12.6f} {}\n", 1e-9 * static_cast<double>(at), line);
      };
    }
    const MatrixRun run = matrix_.run(cell, seed, before.diary, trace);
    MatrixVerdict verdict = verdict_of(cell, run, before);
    const std::lock_guard lock(mutex_);
    verdicts_.emplace(std::pair{index, seed}, std::move(verdict));
  }

  const Choices& choices_;
  FaultMatrix matrix_;
  std::vector<CellResult> results_;
  std::map<std::pair<std::string, std::uint64_t>, MatrixRun> undisturbed_;
  std::mutex mutex_;
  std::map<std::pair<std::size_t, std::uint64_t>, MatrixVerdict> verdicts_;
};

void print_failures(const std::vector<CellResult>& results) {
  for (const CellResult& result : results) {
    if (result.failed == 0) continue;
    fmt::print("{}\n  again: fault_matrix --cells \"{}\" --seed {} --trace trace.txt\n",
               describe_failure(result), to_string(result.cell), result.failing_seed.value_or(0));
  }
}

int drive(Choices choices) {
  if (choices.scenario_folder.empty()) {
    choices.scenario_folder =
        std::filesystem::read_symlink("/proc/self/exe").parent_path() / "scenarios";
  }
  if (!choices.trace.empty() && (cells_of(choices.cells).size() != 1 || choices.runs != 1)) {
    throw std::invalid_argument("--trace: is of one run: --cells must be the name of one cell");
  }
  Matrix matrix(choices);
  const std::vector<CellResult>& results = matrix.drive();
  print_failures(results);
  const hlc::closed_loop::MatrixTotals totals = totals_of(results);
  fmt::print("{}\n", describe(totals));
  if (!choices.report.empty()) {
    write_report(choices.report, fmt::format("`fault_matrix --runs {} --seed {}`: {}", choices.runs,
                                             choices.seed, matrix_report(results)));
  }
  return totals.failed == 0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  hlc::apps::CommandLine app(
      "Runs of three cars in memory, each with one fault of one process: every role, fault, phase "
      "and kind of run.",
      "fault_matrix");
  hlc::apps::declare_help_end(
      app,
      {.examples = {"fault_matrix --jobs 2",
                    "fault_matrix --cells \"controller, kill\" --runs 5 --table matrix.md"},
       .exit_codes = "0 all cells passed, or failed by a known weakness only, 1 a cell failed, 2 "
                     "invalid input or an output that cannot be written, 130 interrupted"});
  Choices choices;
  app.add_option("--runs", choices.runs, "number of runs of each cell, with a seed each")
      ->check(hlc::apps::whole(1, kMostRuns))
      ->capture_default_str();
  app.add_option("--seed", choices.seed, "of the first run; the next ones count on")
      ->check(hlc::apps::whole(0, kLargestSeed))
      ->capture_default_str();
  app.add_option("--jobs", choices.jobs, "threads (default: as many as cores)")
      ->check(hlc::apps::whole(1, 256));
  app.add_option("--cells", choices.cells,
                 "only those with this text in their name, as \"controller, kill, run: real time, "
                 "lab, two rounds\"; default: all");
  app.add_option("--table", choices.report,
                 "Markdown file for the table; of one with the marks of the table only that is "
                 "replaced; default: none")
      ->type_name("FILE");
  app.add_option("--trace", choices.trace,
                 "file for what happens, of one cell and run; default: none")
      ->type_name("FILE");
  app.add_option("--scenario_folder", choices.scenario_folder,
                 "folder of the scenarios (default: scenarios beside the program)")
      ->type_name("DIR");
  if (const auto code = hlc::apps::parse_flags(app, argc, argv, {{"--report", "--table"}})) {
    return *code;
  }
  return hlc::apps::exit_code_of("fault_matrix", [&] { return drive(choices); });
}
