#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

/// Reads MCAP files by their specification, independently of `hlc_bridge/mcap`.
namespace hlc::test {

struct McapMessage {
  std::string topic;
  std::string type;
  std::map<std::string, std::string> metadata;  ///< of the channel
  std::uint32_t sequence{};
  std::uint64_t log_time{};
  std::uint64_t publish_time{};
  std::string payload;

  friend bool operator==(const McapMessage&, const McapMessage&) = default;
};

/// All messages of a file with an index, in the order of the chunks; only through the index.
/// @throws std::runtime_error if a place, a number or a checksum of the index or of a chunk is
/// wrong
[[nodiscard]] std::vector<McapMessage> read_by_index(const std::filesystem::path& file);

/// All whole messages of a file without chunks, from its begin on, also of one that is cut off.
[[nodiscard]] std::vector<McapMessage> read_from_begin(const std::filesystem::path& file);

}  // namespace hlc::test
