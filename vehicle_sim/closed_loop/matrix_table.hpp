#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "vehicle_sim/closed_loop/matrix_verdict.hpp"

namespace hlc::closed_loop {

/// What the runs of one cell come to.
struct CellResult {
  MatrixCell cell;
  std::uint64_t runs{};
  std::uint64_t failed{};
  std::uint64_t standing{};  ///< runs in which all affected cars stand
  double standstill_s{};     ///< the longest time until they do
  double least_distance_m{1e9};
  std::map<Naming, std::uint64_t> namings;
  /// Of the first run that failed.
  std::optional<std::uint64_t> failing_seed;
  std::string failure;
  void add(std::uint64_t seed, const MatrixVerdict& verdict);
  /// All failures are of a known weakness.
  bool is_known{true};
};

/// Numbers of cells.
struct MatrixTotals {
  std::size_t run{};
  std::size_t passed{};
  std::size_t known{};   ///< failed, by a known weakness only
  std::size_t failed{};  ///< otherwise
  std::map<NotRunReason, std::size_t> not_run;
};

/// Of all cells, those that are not run included.
[[nodiscard]] MatrixTotals totals_of(const std::vector<CellResult>& results);
/// "480 cells run, 476 passed, ..."
[[nodiscard]] std::string describe(const MatrixTotals& totals);
/// "FAILED controller, kill, run: real time, lab, two rounds: 1 of 4 runs, seed 3: culprit: ..."
[[nodiscard]] std::string describe_failure(const CellResult& result);

/// The report in Markdown: the totals, a row per role, fault and phase with real time beside
/// logical time, and the cells that failed.
[[nodiscard]] std::string matrix_report(const std::vector<CellResult>& results);

}  // namespace hlc::closed_loop
