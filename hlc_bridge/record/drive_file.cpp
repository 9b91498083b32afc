#include "hlc_bridge/record/drive_file.hpp"

#include <fmt/format.h>

#include "planner/common/csv.hpp"

namespace hlc::record {

std::filesystem::path drive_file(const std::filesystem::path& run_folder, std::uint8_t vehicle_id) {
  return run_folder / fmt::format("vehicle_{}.csv", vehicle_id);
}

result::Drive read_drive(const std::filesystem::path& file) {
  const CsvTable table{file, kDriveHeading};
  result::Drive drive;
  drive.reserve(table.size());
  for (std::size_t row = 0; row < table.size(); ++row) {
    result::DrivenSample sample;
    sample.t = table.unsigned_number(row, 0);
    sample.pose = {table.number(row, 1), table.number(row, 2), table.number(row, 3)};
    sample.speed_mps = table.number(row, 4);
    sample.throttle = table.number(row, 5);
    sample.steering = table.number(row, 6);
    sample.command_create = table.unsigned_number(row, 7);
    if (!drive.empty() && sample.t <= drive.back().t) {
      table.refuse(row, 0, "larger than in the row before");
    }
    drive.push_back(sample);
  }
  return drive;
}

result::Drives read_drives(const std::filesystem::path& run_folder,
                           const std::vector<std::uint8_t>& vehicle_ids) {
  result::Drives drives;
  for (const std::uint8_t id : vehicle_ids) {
    const std::filesystem::path file = drive_file(run_folder, id);
    if (std::filesystem::exists(file)) drives[id] = read_drive(file);
  }
  return drives;
}

}  // namespace hlc::record
