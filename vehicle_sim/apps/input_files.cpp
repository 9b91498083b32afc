#include "vehicle_sim/apps/input_files.hpp"

#include "planner/common/sha256.hpp"
#include "planner/common/text_file.hpp"

namespace hlc::apps {

nlohmann::ordered_json input_files(const std::set<std::filesystem::path>& files) {
  auto list = nlohmann::ordered_json::array();
  for (const std::filesystem::path& file : files) {
    list.push_back({{"file", file.filename().string()}, {"sha256", sha256_of(read_file(file))}});
  }
  return list;
}

std::string this_program_sha256() {
  static const std::string hash = sha256_of(read_file("/proc/self/exe"));
  return hash;
}

}  // namespace hlc::apps
