#include "hlc_bridge/doctor/shared_memory.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <set>

namespace hlc::doctor {
namespace {

namespace fs = std::filesystem;

constexpr std::array<const char*, 3> kPrefixes{"fastrtps_", "fast_datasharing_", "sem.fastrtps_"};

bool is_number(const std::string& text) {
  return !text.empty() &&
         std::ranges::all_of(text, [](unsigned char c) { return std::isdigit(c); });
}

/// Files that processes have mapped.
std::set<std::string> mapped_files(const fs::path& folder, const fs::path& proc) {
  std::set<std::string> files;
  std::error_code ignored;  // processes end while they are inspected
  for (const fs::directory_entry& process : fs::directory_iterator(proc, ignored)) {
    if (!is_number(process.path().filename())) continue;
    std::ifstream maps(process.path() / "maps");
    const std::string prefix = folder.string() + "/";
    for (std::string line; std::getline(maps, line);) {
      const std::size_t begin = line.find(prefix);
      if (begin != std::string::npos) files.insert(line.substr(begin + prefix.size()));
    }
  }
  return files;
}

}  // namespace

std::vector<SharedMemoryFile> shared_memory_files(const fs::path& folder, const fs::path& proc) {
  const std::set<std::string> mapped = mapped_files(folder, proc);
  std::vector<SharedMemoryFile> files;
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored)) {
    const std::string name = entry.path().filename();
    const bool is_ours = std::ranges::any_of(
        kPrefixes, [&](const char* prefix) { return name.starts_with(prefix); });
    if (!is_ours) continue;
    const std::uintmax_t bytes = entry.file_size(ignored);
    files.push_back({name, ignored ? 0 : bytes, mapped.contains(name)});
  }
  // The lock file of a segment or port (…_el) is in use if that segment or port is.
  for (SharedMemoryFile& file : files) {
    const std::string locked =
        file.name.ends_with("_el") ? file.name.substr(0, file.name.size() - 3) : file.name;
    file.is_used = file.is_used || mapped.contains(locked);
  }
  std::ranges::sort(files, {}, &SharedMemoryFile::name);
  return files;
}

Finding leftovers(const std::vector<SharedMemoryFile>& files) {
  std::size_t count = 0;
  double bytes = 0.0;
  const SharedMemoryFile* example = nullptr;
  for (const SharedMemoryFile& file : files) {
    if (file.is_used) continue;
    ++count;
    bytes += static_cast<double>(file.bytes);
    example = &file;
  }
  if (count == 0) {
    return {Verdict::kGood,
            fmt::format("shared memory: nothing left over ({} files in use)", files.size()), ""};
  }
  return {Verdict::kNote,
          fmt::format("shared memory: {} unused files in /dev/shm, {} MB, such as {}", count,
                      static_cast<int>(bytes / 1e6), example->name),
          "remove them when no program of the lab runs: rm /dev/shm/*fastrtps_* "
          "/dev/shm/fast_datasharing_*"};
}

}  // namespace hlc::doctor
