#include "tests/integration/recorded_commands.hpp"

#include <cinttypes>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <string>

namespace hlc::test {

void append(const TrajectoryCommand& command, std::FILE& file) {
  std::fprintf(&file, "%d %" PRIu64 " %" PRIu64, int{command.vehicle_id}, command.create_stamp,
               command.valid_after_stamp);
  for (const TrajectoryPoint& point : command.points) {
    std::fprintf(&file, " %" PRIu64 " %.17g %.17g %.17g %.17g", point.t, point.x_m, point.y_m,
                 point.vx_mps, point.vy_mps);
  }
  if (std::fprintf(&file, "\n") < 0 || std::fflush(&file) != 0) {
    throw std::runtime_error("the file of the commands cannot be written");
  }
}

Commands read_commands(const std::filesystem::path& file) {
  Commands commands;
  std::ifstream stream(file);
  std::string line;
  while (std::getline(stream, line) && !stream.eof()) {
    std::istringstream fields(line);
    int vehicle = 0;
    TrajectoryCommand command;
    fields >> vehicle >> command.create_stamp >> command.valid_after_stamp;
    command.vehicle_id = static_cast<std::uint8_t>(vehicle);
    TrajectoryPoint point;
    while (fields >> point.t >> point.x_m >> point.y_m >> point.vx_mps >> point.vy_mps) {
      command.points.push_back(point);
    }
    const std::pair key{command.vehicle_id, command.create_stamp};
    commands.insert_or_assign(key, std::move(command));
  }
  return commands;
}

bool is_newest_sent_whole(const Commands& commands, std::uint8_t vehicle) {
  const auto after = commands.upper_bound({vehicle, ~Nanoseconds{0}});
  if (after == commands.begin()) return false;
  const auto& [key, newest] = *std::prev(after);
  return key.first == vehicle && newest.valid_after_stamp > newest.create_stamp;
}

}  // namespace hlc::test
