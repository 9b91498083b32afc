#include "hlc_bridge/doctor/shared_memory.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <map>
#include <set>

namespace hlc::doctor {
namespace {

namespace fs = std::filesystem;

constexpr std::array<const char*, 3> kPrefixes{"fastrtps_", "fast_datasharing_", "sem.fastrtps_"};

bool is_number(const std::string& text) {
  return !text.empty() &&
         std::ranges::all_of(text, [](unsigned char c) { return std::isdigit(c); });
}

/// The segment or port to which a lock file (..._el, ..._sl) or a semaphore (sem...._mutex)
/// belongs: in use if that is. Other names as they are.
std::string guarded_by(std::string name) {
  constexpr std::string_view kSemaphore = "sem.";
  for (const std::string_view suffix : {"_el", "_sl", "_mutex"}) {
    if (name.ends_with(suffix)) name.resize(name.size() - suffix.size());
  }
  if (name.starts_with(kSemaphore)) name.erase(0, kSemaphore.size());
  return name;
}

std::string name_of(const fs::path& process) {
  std::string name;
  std::getline(std::ifstream(process / "comm"), name);
  return name + " (" + process.filename().string() + ")";
}

/// Files that processes have mapped, with these processes.
std::map<std::string, std::set<std::string>> mapped_files(const fs::path& folder,
                                                          const fs::path& proc) {
  std::map<std::string, std::set<std::string>> files;
  std::error_code ignored;  // processes end while they are inspected
  for (const fs::directory_entry& process : fs::directory_iterator(proc, ignored)) {
    if (!is_number(process.path().filename())) continue;
    std::ifstream maps(process.path() / "maps");
    const std::string prefix = folder.string() + "/";
    for (std::string line; std::getline(maps, line);) {
      const std::size_t begin = line.find(prefix);
      if (begin == std::string::npos) continue;
      files[line.substr(begin + prefix.size())].insert(name_of(process.path()));
    }
  }
  return files;
}

}  // namespace

std::vector<SharedMemoryFile> shared_memory_files(const fs::path& folder, const fs::path& proc) {
  const std::map<std::string, std::set<std::string>> mapped = mapped_files(folder, proc);
  std::vector<SharedMemoryFile> files;
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored)) {
    const std::string name = entry.path().filename();
    const bool is_ours = std::ranges::any_of(
        kPrefixes, [&](const char* prefix) { return name.starts_with(prefix); });
    if (!is_ours) continue;
    const std::uintmax_t bytes = entry.file_size(ignored);
    files.push_back({name, ignored ? 0 : bytes, {}});
  }
  for (SharedMemoryFile& file : files) {
    for (const std::string& mapping : {file.name, guarded_by(file.name)}) {
      if (const auto found = mapped.find(mapping); found != mapped.end()) {
        file.users.insert(found->second.begin(), found->second.end());
      }
    }
  }
  std::ranges::sort(files, {}, &SharedMemoryFile::name);
  return files;
}

Finding leftovers(const std::vector<SharedMemoryFile>& files) {
  std::size_t count = 0;
  double bytes = 0.0;
  const SharedMemoryFile* example = nullptr;
  std::set<std::string> users;
  for (const SharedMemoryFile& file : files) {
    users.insert(file.users.begin(), file.users.end());
    if (!file.users.empty()) continue;
    ++count;
    bytes += static_cast<double>(file.bytes);
    example = &file;
  }
  const std::string in_use =
      users.empty()
          ? "none in use"
          : fmt::format("{} files in use by {}", files.size() - count, fmt::join(users, ", "));
  if (count == 0) return {Verdict::kGood, "shared memory: nothing left over; " + in_use, ""};
  return {Verdict::kNote,
          fmt::format("shared memory: {} unused files in /dev/shm, {} MB, such as {}; {}", count,
                      static_cast<int>(bytes / 1e6), example->name, in_use),
          "they may belong to processes of another user, which this one may not inspect; remove "
          "them when no program of the lab runs: rm /dev/shm/*fastrtps_* "
          "/dev/shm/fast_datasharing_*"};
}

}  // namespace hlc::doctor
