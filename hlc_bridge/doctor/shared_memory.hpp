#pragma once

#include <cstdint>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "hlc_bridge/doctor/finding.hpp"

namespace hlc::doctor {

/// A shared-memory file of Fast DDS: a segment, a port, or a shared history.
struct SharedMemoryFile {
  std::string name;
  std::uintmax_t bytes{};
  /// Processes that have mapped it, such as "middleware (4711)"; only those that this user may
  /// inspect
  std::set<std::string> users;
};

/// Those of a folder, by name. A process that dies leaves its files behind.
/// @param proc  where processes are looked up
[[nodiscard]] std::vector<SharedMemoryFile> shared_memory_files(
    const std::filesystem::path& folder = "/dev/shm", const std::filesystem::path& proc = "/proc");

/// Reports which processes use the files, and the files that none uses.
[[nodiscard]] Finding leftovers(const std::vector<SharedMemoryFile>& files);

}  // namespace hlc::doctor
