#include "vehicle_sim/closed_loop/matrix_table.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace hlc::closed_loop {
namespace {

const char* text_of(Naming naming) {
  switch (naming) {
    case Naming::kLog:
      return "log";
    case Naming::kReport:
      return "report";
    case Naming::kByItself:
      return "itself";
    case Naming::kNoEffect:
      return "no effect";
    case Naming::kNone:
      return "**nothing**";
  }
  return "";
}

/// Half a row: all setups of one kind of time.
struct Half {
  std::uint64_t runs{};
  std::uint64_t failed{};
  std::uint64_t standing{};
  double standstill_s{};
  double least_distance_m{1e9};
  std::map<Naming, std::uint64_t> namings;

  void add(const CellResult& result) {
    runs += result.runs;
    failed += result.failed;
    standing += result.standing;
    standstill_s = std::max(standstill_s, result.standstill_s);
    least_distance_m = std::min(least_distance_m, result.least_distance_m);
    for (const auto& [naming, count] : result.namings) namings[naming] += count;
  }
};

std::string standstill_text(const Half& half) {
  if (half.standing == 0) return "-";
  const std::string time = fmt::format("{:.1f}", half.standstill_s);
  return half.standing == half.runs ? time : fmt::format("{} ({})", time, half.standing);
}

std::string namings_text(const Half& half) {
  std::string text;
  for (const auto& [naming, count] : half.namings) {
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", text_of(naming), count);
  }
  return text;
}

std::string text_of(const Half& half) {
  return fmt::format("{} of {} | {} | {:.0f} | {} |", half.runs - half.failed, half.runs,
                     standstill_text(half), 1e3 * half.least_distance_m, namings_text(half));
}

std::string why_not_run(const std::vector<MatrixCell>& cells, bool is_logical) {
  std::string text;
  for (const MatrixCell& cell : cells) {
    if (cell.setup.is_logical != is_logical) continue;
    const std::optional<NotRun> reason = not_run(cell);
    if (!reason) continue;
    const char* const kind = reason->reason == NotRunReason::kNoMeaning   ? "no meaning: "
                             : reason->reason == NotRunReason::kOtherTest ? "not run, test: "
                                                                          : "open: ";
    const std::string one = kind + reason->text;
    if (text.find(one) == std::string::npos) text += (text.empty() ? "" : "; ") + one;
  }
  return text + " | | | |";
}

/// Cells of one role, fault and phase.
std::string row_of(const std::vector<MatrixCell>& cells, const std::vector<CellResult>& results) {
  const MatrixCell& first = cells.front();
  std::string row = fmt::format("| {} | {} | {} |", to_string(first.role), to_string(first.fault),
                                to_string(first.phase));
  for (const bool is_logical : {false, true}) {
    Half half;
    for (const CellResult& result : results) {
      const MatrixCell& cell = result.cell;
      const bool is_here = cell.role == first.role && cell.fault == first.fault &&
                           cell.phase == first.phase && cell.setup.is_logical == is_logical;
      if (is_here) half.add(result);
    }
    row += " " + (half.runs > 0 ? text_of(half) : why_not_run(cells, is_logical));
  }
  return row + "\n";
}

}  // namespace

void CellResult::add(std::uint64_t seed, const MatrixVerdict& verdict) {
  ++runs;
  if (verdict.standstill_s) {
    ++standing;
    standstill_s = std::max(standstill_s, *verdict.standstill_s);
  }
  least_distance_m = std::min(least_distance_m, verdict.least_distance_m);
  ++namings[verdict.naming];
  if (verdict.problems.empty()) return;
  ++failed;
  const bool is_of_weakness =
      known_weakness(cell) && std::ranges::all_of(verdict.problems, [](const Violation& one) {
        return one.check == "culprit";
      });
  is_known = is_known && is_of_weakness;
  if (failing_seed) return;
  failing_seed = seed;
  const Violation& problem = verdict.problems.front();
  failure = problem.check + ": " + problem.text;
}

MatrixTotals totals_of(const std::vector<CellResult>& results) {
  MatrixTotals totals;
  for (const CellResult& result : results) {
    ++totals.run;
    ++(result.failed == 0 ? totals.passed : result.is_known ? totals.known : totals.failed);
  }
  for (const MatrixCell& cell : matrix_cells()) {
    if (const auto reason = not_run(cell)) ++totals.not_run[reason->reason];
  }
  return totals;
}

std::string describe(const MatrixTotals& totals) {
  const auto not_run = [&](NotRunReason reason) {
    const auto found = totals.not_run.find(reason);
    return found == totals.not_run.end() ? 0 : found->second;
  };
  return fmt::format(
      "{} cells run: {} passed, {} failed by a known weakness, {} failed otherwise; not run: {} "
      "without meaning, {} covered by other tests, {} open",
      totals.run, totals.passed, totals.known, totals.failed, not_run(NotRunReason::kNoMeaning),
      not_run(NotRunReason::kOtherTest), not_run(NotRunReason::kOpen));
}

std::string describe_failure(const CellResult& result) {
  std::string text =
      fmt::format("{}: {} of {} runs, first with seed {}: {}", to_string(result.cell),
                  result.failed, result.runs, result.failing_seed.value_or(0), result.failure);
  if (result.is_known) text += " (known: " + known_weakness(result.cell).value_or("") + ")";
  return text;
}

std::string matrix_report(const std::vector<CellResult>& results) {
  std::string text = describe(totals_of(results)) + ".\n\n";
  text +=
      "| | | | real time | | | | logical time | | | |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|\n"
      "| role | fault | phase | passed | stands [s] | closest [mm] | named by | passed | stands "
      "[s] "
      "| closest [mm] | named by |\n";
  std::vector<MatrixCell> row;
  const std::size_t setups = matrix_setups().size();
  for (const MatrixCell& cell : matrix_cells()) {
    row.push_back(cell);
    if (row.size() < setups) continue;
    text += row_of(row, results);
    row.clear();
  }
  text += "\n";
  for (const CellResult& result : results) {
    if (result.failed > 0) text += "* " + describe_failure(result) + "\n";
  }
  return text;
}

}  // namespace hlc::closed_loop
