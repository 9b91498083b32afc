#include "vehicle_sim/apps/drive_recorder.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <stdexcept>

#include "hlc_bridge/record/drive_file.hpp"
#include "planner/common/text_file.hpp"

namespace hlc::apps {

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

DriveRecorder::DriveRecorder(const std::string& file, bool append) : file_(file) {
  const bool goes_on = append && ends_with_a_row(file);
  stream_.open(file, goes_on ? std::ios::app : std::ios::trunc);
  if (!goes_on) stream_ << record::kDriveHeading << '\n' << std::flush;
  check();
}

void DriveRecorder::check() const {
  if (!stream_) throw std::runtime_error(file_ + ": cannot be written");
}

void DriveRecorder::write(const result::DrivenSample& sample) {
  stream_ << fmt::format("{},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{}\n", sample.t,
                         sample.pose.x_m, sample.pose.y_m, sample.pose.heading_rad,
                         sample.speed_mps, sample.throttle, sample.steering, sample.command_create)
          << std::flush;
  check();
}

}  // namespace hlc::apps
