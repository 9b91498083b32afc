#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hlc_bridge/result/first_difference.hpp"
#include "hlc_bridge/result/run_summary.hpp"

namespace hlc::result {

/// One of two compared runs.
struct ComparedRun {
  std::string name;  ///< of its folder
  RunSummary summary;
  RunFacts facts;
  std::vector<StepRecord> rows;
  Drives drives;
  std::vector<std::string> incomplete;  ///< records that end early, one line each
};

struct RunComparison {
  ComparedRun a;
  ComparedRun b;
  std::vector<std::string> started;  ///< in what they were started differently, one line each
  std::optional<Difference> first;   ///< of their rows
  WayDifference ways;                ///< of their rows
  /// In what runs with equal rows differ: whether all steps were driven, or what was driven between
  /// two steps. Empty: in nothing.
  std::string other_difference;

  [[nodiscard]] bool are_equal() const { return !first && other_difference.empty(); }
};

/// Numbers of both runs as text.
struct ComparisonTable {
  std::vector<std::string> heading;
  std::vector<std::vector<std::string>> rows;  ///< of as many cells as the heading
  std::vector<std::string> legend;             ///< what the columns mean, one line each
};

/// Compares rows, and if they are equal how the runs ended and the hashes of their summaries.
/// @param started  of record::start_differences
/// @throws std::invalid_argument if neither run has a row
[[nodiscard]] RunComparison compare(ComparedRun a, ComparedRun b, std::vector<std::string> started);

/// The runs, how their starts differ, which records end early, and in the last line the first
/// difference ("at step 57 (11.4 s), vehicle 3: ...") or that the runs are equal.
[[nodiscard]] std::vector<std::string> comparison_lines(const RunComparison& comparison);

/// A row per vehicle if both runs have the same numbers as printed, else one per run; times that
/// were measured by a clock are not in it.
[[nodiscard]] ComparisonTable vehicle_table(const RunComparison& comparison);

/// Numbers of the whole runs, in a column per run.
[[nodiscard]] ComparisonTable run_table(const RunComparison& comparison);

/// The lines and both tables; ends with a line break.
[[nodiscard]] std::string comparison_text(const RunComparison& comparison);

}  // namespace hlc::result
