#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "hlc_bridge/messages/run_messages.hpp"
#include "planner/common/growing_file.hpp"

namespace hlc::record {

/// reports.csv: every report of a run. One line per report as it arrives, written at once, so that
/// a crash of the program loses nothing; sorted by step, then vehicle, at the end. A line that
/// cannot be written is no reason to stop (GrowingFile).
///
/// Until then the lines are in memory, too, up to kMostKept bytes: of 10 000 steps of five cars.
/// The file of a longer run, or of a controller that reports without end, stays in the order of
/// arrival.
class ReportFile {
 public:
  /// Starts an empty file. @throws std::runtime_error naming the file
  ReportFile(std::filesystem::path file, GrowingFile::OnFailure on_failure);

  void append(const ReportRecord& record);
  /// Writes the sorted file in place of the present one, unless it is longer than kMostKept. Empty
  /// if that has every report, also those that could not be appended; else a line for the log.
  std::optional<std::string> finish();

  static constexpr std::size_t kMostKept = std::size_t{32} << 20U;

 private:
  struct Line {
    StepIndex step;
    VehicleId vehicle;
    std::string text;
  };

  GrowingFile file_;
  std::vector<Line> lines_;  ///< none once there were more than kMostKept bytes
  std::size_t bytes_{};
};

/// @throws std::runtime_error naming file, line, column, value and bound
[[nodiscard]] std::vector<ReportRecord> read_reports(const std::filesystem::path& file);

/// Ids in one field: "2;3", empty for none.
[[nodiscard]] std::string ids_to_text(const std::vector<VehicleId>& ids);

}  // namespace hlc::record
