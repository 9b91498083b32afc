#pragma once

#include <fstream>
#include <string>

#include "hlc_bridge/result/run_record.hpp"

namespace hlc::apps {

/// Writes a vehicle's true motion as CSV with the heading `kDriveHeading`, one row per tick: the
/// pose, and the inputs given then (they act 80 ms later). `hlc_bridge/record/drive_file.hpp` reads
/// it.
///
/// Numbers have 17 significant digits, so reading them back gives the same bits. Every row is
/// flushed: the record survives a crash.
class DriveRecorder {
 public:
  /// @param append  continue after the rows of a process that ended before, dropping an incomplete
  /// row
  /// @throws std::runtime_error if the file cannot be written
  explicit DriveRecorder(const std::string& file, bool append = false);

  /// @throws std::runtime_error if the row cannot be written
  void write(const result::DrivenSample& sample);

 private:
  void check() const;

  std::string file_;
  std::ofstream stream_;
};

}  // namespace hlc::apps
