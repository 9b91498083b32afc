#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "vehicle_sim/apps/evaluation_results.hpp"
#include "vehicle_sim/apps/run_log.hpp"
#include "vehicle_sim/campaign/sweep.hpp"

namespace hlc::apps {

/// The folder of a sweep:
///
///     runs.jsonl             first line: all files that the sweep reads with their hashes,
///                            revision; then a line per run, once driven
///     runs.csv               a row per run with its settings (row_tables.hpp)
///     campaign.json          what was swept: the settings with their values
///
/// A run's record: "run" (its number), "failure" (null, or why it does not count), and, if it was
/// driven, "figures" (figures_record.hpp) and "trace_sha256".
///
/// An interrupted sweep continues with the runs that are missing in runs.jsonl.
class SweepFiles {
 public:
  /// @throws std::invalid_argument as RunLog
  SweepFiles(std::filesystem::path folder, const campaign::Sweep& sweep);

  [[nodiscard]] bool has(std::size_t run) const { return log_.has(run); }

  /// From any thread. @throws std::runtime_error if it cannot be written
  void add(std::size_t run, const campaign::SweepResult& result);

  /// Of all runs, in the order of the sweep. @pre all are there
  [[nodiscard]] std::vector<campaign::RunFigures> figures() const;
  /// Writes runs.csv and campaign.json. @pre all runs are there
  void finish(const EvaluationOrigin& origin) const;

 private:
  const campaign::Sweep& sweep_;
  RunLog log_;
};

}  // namespace hlc::apps
