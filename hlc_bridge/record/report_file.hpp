#pragma once

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "hlc_bridge/messages/run_messages.hpp"

namespace hlc::record {

/// reports.csv: every report of a run. One line per report as it arrives, flushed to the system at
/// once, so that a crash of the program loses nothing; sorted by step, then vehicle, at the end.
class ReportFile {
 public:
  /// Starts an empty file. @throws std::runtime_error naming the file
  explicit ReportFile(std::filesystem::path file);

  /// @throws std::runtime_error naming the file
  void append(const ReportRecord& record);
  /// Writes the sorted file in place of the present one. @throws std::runtime_error naming the file
  void finish();

 private:
  std::filesystem::path file_;
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> stream_;
  std::vector<ReportRecord> records_;
};

/// @throws std::runtime_error naming file, line, column, value and bound
[[nodiscard]] std::vector<ReportRecord> read_reports(const std::filesystem::path& file);

/// Ids in one field: "2;3", empty for none.
[[nodiscard]] std::string ids_to_text(const std::vector<VehicleId>& ids);

}  // namespace hlc::record
