#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <utility>
#include <vector>

#include "hlc_bridge/result/run_record.hpp"

namespace hlc::record {

/// More lines than this are left out, the last ones; one line more states how many.
inline constexpr std::size_t kMostLoggedLines = 5000;

/// The lines of all files `*.log` in the folder, by their stamps; lines without a stamp follow the
/// one before them in their file. Stamps are local times of the machine that logged: times of the
/// run are right if this machine's time zone is the same.
/// @return nothing if there is no such folder
/// @throws std::runtime_error naming the file that cannot be read
[[nodiscard]] std::vector<result::LoggedLine> read_logs(const std::filesystem::path& folder,
                                                        const result::RunFacts& facts);

/// The same while the processes write: their new lines, again and again. A line without its end is
/// left for the next time; lines beyond kMostLoggedLines, counted from the first call on, are left
/// out, and one more states that. Lines that are read before the first step is known have no time
/// of the run.
class GrowingLogs {
 public:
  explicit GrowingLogs(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// Since the last call, by their stamps. Files that cannot be read have none, for now.
  [[nodiscard]] std::vector<result::LoggedLine> new_lines(const result::RunFacts& facts);

 private:
  std::filesystem::path folder_;
  std::map<std::filesystem::path, std::size_t> read_bytes_;
  std::size_t num_lines_{};
};

}  // namespace hlc::record
