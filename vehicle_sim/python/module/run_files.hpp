#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "hlc_bridge/record/configuration.hpp"
#include "hlc_bridge/result/run_record.hpp"
#include "planner/scenario/scenario.hpp"
#include "vehicle_sim/closed_loop/experiment.hpp"

namespace hlc::python {

/// What is driven, and with what.
struct RunConfiguration {
  const scenario::Scenario& scenario;
  const std::string& changed_text;  ///< of its file; empty: the file's own
  std::optional<std::uint64_t> noise_seed;
  const std::vector<record::KeptFork>& forks;
};

/// The folder of a run, with the files of run_lab.sh but logs and messages (hlc_bridge/record). If
/// it is not completed, as when the run is interrupted, it is empty in the end.
class RunFolderWriter {
 public:
  /// Makes the folder and writes the configuration, with which programs drive the run again.
  /// @throws std::invalid_argument naming the folder if it cannot be made, or has something in it;
  /// std::runtime_error naming the file that cannot be read or written
  RunFolderWriter(std::filesystem::path folder, const RunConfiguration& run);
  ~RunFolderWriter();
  RunFolderWriter(const RunFolderWriter&) = delete;
  RunFolderWriter& operator=(const RunFolderWriter&) = delete;

  /// Writes result, page and records.
  /// @throws std::runtime_error naming the file that cannot be written
  void complete(const RunConfiguration& run, const closed_loop::Experiment& experiment,
                const std::vector<result::StepRecord>& rows);

 private:
  std::filesystem::path folder_;
  bool is_complete_{};
};

}  // namespace hlc::python
