#pragma once

#include <fstream>
#include <string>

#include "hlc_bridge/core/run_record.hpp"

namespace hlc {

/// Writes what a vehicle truly drives as CSV, one row per tick:
///
///     t_ns,x_m,y_m,yaw_rad,speed_mps,throttle,steering,command_create_ns
///
/// Numbers have 17 significant digits, so reading them back gives the same bits. Every row is
/// flushed: the record survives a crash.
class DriveRecorder {
 public:
  /// @throws std::runtime_error if the file cannot be written
  explicit DriveRecorder(const std::string& file);

  void write(const DrivenSample& sample);

 private:
  std::ofstream stream_;
};

}  // namespace hlc
