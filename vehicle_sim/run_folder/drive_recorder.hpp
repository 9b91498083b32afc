#pragma once

#include <optional>
#include <string>

#include "hlc_bridge/result/run_record.hpp"
#include "planner/common/growing_file.hpp"

namespace hlc::run_folder {

/// Writes a vehicle's true motion as CSV with the heading `kDriveHeading`, one row per tick: the
/// pose, and the inputs given then (they act 80 ms later). `hlc_bridge/record/drive_file.hpp` reads
/// it.
///
/// Numbers have 17 significant digits, so reading them back gives the same bits. Every row is
/// written at once: the record survives a crash. A row that cannot be written is no reason to stop
/// (GrowingFile).
class DriveRecorder {
 public:
  /// @param append  continue after the rows of a process that ended before, dropping an incomplete
  /// row
  /// @throws std::runtime_error naming the file if it cannot be opened or its heading written
  DriveRecorder(const std::string& file, GrowingFile::OnFailure on_failure, bool append = false);

  void write(const result::DrivenSample& sample);
  /// GrowingFile
  std::optional<std::string> close() { return file_.close(); }

 private:
  DriveRecorder(const std::string& file, GrowingFile::OnFailure on_failure,
                GrowingFile::Opening opening);

  GrowingFile file_;
};

}  // namespace hlc::run_folder
