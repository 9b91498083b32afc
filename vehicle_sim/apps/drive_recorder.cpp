#include "vehicle_sim/apps/drive_recorder.hpp"

#include <limits>
#include <locale>
#include <stdexcept>

#include "hlc_bridge/record/drive_file.hpp"

namespace hlc {

DriveRecorder::DriveRecorder(const std::string& file) : file_(file), stream_(file) {
  stream_.imbue(std::locale::classic());
  stream_.precision(std::numeric_limits<double>::max_digits10);
  stream_ << kDriveHeading << '\n' << std::flush;
  check();
}

void DriveRecorder::check() const {
  if (!stream_) throw std::runtime_error(file_ + ": cannot be written");
}

void DriveRecorder::write(const DrivenSample& sample) {
  stream_ << sample.t << ',' << sample.pose.x_m << ',' << sample.pose.y_m << ','
          << sample.pose.heading_rad << ',' << sample.speed_mps << ',' << sample.throttle << ','
          << sample.steering << ',' << sample.command_create << '\n'
          << std::flush;
  check();
}

}  // namespace hlc
