#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "vehicle_sim/apps/run_log.hpp"
#include "vehicle_sim/campaign/campaign.hpp"

namespace hlc::apps {

/// The folder of a campaign:
///
///     runs.jsonl           first line: what the campaign is, with the hashes of all files that it
///                          reads; then a line per run, once driven
///     runs.csv, cars.csv   a row per run, and per run and car (row_tables.hpp)
///     campaign.json        that first line, and where the rows come from
///     series/              what evaluation_series.hpp writes
///
/// A run's record has the keys of summary.json and "run" (its number), "start", "policy" (`none`
/// for a fixed subgraph), "failure" (null, or why the run does not count) and "figures"
/// (figures_record.hpp). Planning times are processor time of the thread, all others wall time. If
/// the run could not be driven to its end, only scenario, profile, subgraph and policy are there of
/// the other keys; if it was driven, but does not count (CampaignResult::fault), all are.
///
/// An interrupted campaign continues with the runs that are missing in runs.jsonl.
class EvaluationFiles {
 public:
  /// Makes the folder, or opens that of the same campaign.
  /// @throws std::invalid_argument naming the folder if it holds anything else, or a campaign of
  /// other choices or another program
  EvaluationFiles(std::filesystem::path folder, const campaign::Campaign& campaign);

  [[nodiscard]] const std::filesystem::path& folder() const { return log_.folder(); }
  [[nodiscard]] bool has(std::size_t run) const { return log_.has(run); }

  /// From any thread. @throws std::runtime_error if it cannot be written
  void add(std::size_t run, const campaign::CampaignResult& result);
  void add_failure(std::size_t run, const std::string& reason);

  /// All rows, for their results (evaluation_results.hpp).
  [[nodiscard]] const RunLog& rows() const { return log_; }

 private:
  const campaign::Campaign& campaign_;
  RunLog log_;
};

}  // namespace hlc::apps
