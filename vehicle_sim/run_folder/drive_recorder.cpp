#include "vehicle_sim/run_folder/drive_recorder.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <utility>

#include "hlc_bridge/record/drive_file.hpp"
#include "planner/common/text_file.hpp"

namespace hlc::run_folder {

namespace {

/// Keeps the heading and complete rows. False: there are none.
bool ends_with_a_row(const std::string& file) {
  if (!std::filesystem::exists(file)) return false;
  const std::string text = read_file(file);
  const std::size_t end = text.rfind('\n') + 1;  // 0 without a complete line
  if (end < text.size()) std::filesystem::resize_file(file, end);
  return end > 0;
}

}  // namespace

DriveRecorder::DriveRecorder(const std::string& file, GrowingFile::OnFailure on_failure,
                             bool append)
    : DriveRecorder(file, std::move(on_failure),
                    append && ends_with_a_row(file) ? GrowingFile::Opening::kContinued
                                                    : GrowingFile::Opening::kEmptied) {}

DriveRecorder::DriveRecorder(const std::string& file, GrowingFile::OnFailure on_failure,
                             GrowingFile::Opening opening)
    : file_(file, opening, std::move(on_failure)) {
  if (opening == GrowingFile::Opening::kEmptied) {
    file_.begin(std::string(record::kDriveHeading) + '\n');
  }
}

void DriveRecorder::write(const result::DrivenSample& sample) {
  file_.write(fmt::format("{},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{}\n", sample.t,
                          sample.pose.x_m, sample.pose.y_m, sample.pose.heading_rad,
                          sample.speed_mps, sample.throttle, sample.steering,
                          sample.command_create));
}

}  // namespace hlc::run_folder
