#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "hlc_bridge/messages/run_messages.hpp"
#include "planner/common/growing_file.hpp"

namespace hlc::record {

/// certificates.csv: what proves the plan of each report safe (coordination::Certificate), for
/// launch_scripts/check_run.py. One line per report with a certificate, in the order of arrival,
/// written at once.
///
/// | column | content |
/// |---|---|
/// | `step`, `id` | of the report |
/// | `length_m`, `width_m` | of the vehicle, without margin |
/// | `is_agreed` | Certificate::is_agreed |
/// | `areas` | during step k, k+1, ...: the corners as `x y x y ...`, the areas separated by ; |
/// | `standstill` | the area after the last of them, likewise |
/// | `separations` | `ID:KNOWN:direction offset direction offset ...`, separated by ; |
///
/// Lengths [m] and directions [rad] read back to the same bits: areas have edges of a nanometre,
/// whose direction rounding would change.
class CertificateFile {
 public:
  /// Starts an empty file. @throws std::runtime_error naming the file
  CertificateFile(std::filesystem::path file, GrowingFile::OnFailure on_failure);

  /// Nothing without a certificate.
  void append(const ReportRecord& record);
  /// GrowingFile
  std::optional<std::string> close() { return file_.close(); }

 private:
  GrowingFile file_;
};

}  // namespace hlc::record
