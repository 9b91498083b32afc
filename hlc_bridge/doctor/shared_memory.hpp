#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "hlc_bridge/doctor/finding.hpp"

namespace hlc {

/// A file of Fast DDS in shared memory: a segment, a port, or a history that is shared.
struct SharedMemoryFile {
  std::string name;
  std::uintmax_t bytes{};
  bool is_used{};  ///< a process that may be looked at has it mapped
};

/// Those of a folder, by name. A process that dies leaves its files behind.
/// @param proc  where processes are looked up
[[nodiscard]] std::vector<SharedMemoryFile> shared_memory_files(
    const std::filesystem::path& folder = "/dev/shm", const std::filesystem::path& proc = "/proc");

/// Tells of files that nobody uses.
[[nodiscard]] Finding leftovers(const std::vector<SharedMemoryFile>& files);

}  // namespace hlc
