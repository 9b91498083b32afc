#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "hlc_bridge/mcap/records.hpp"

namespace hlc::mcap {

/// Writes an MCAP file in chunks, with the index by which readers find a time and a channel.
/// The file is written beside `file` and renamed by `finish`; without it nothing remains.
class IndexedFile {
 public:
  /// @throws std::runtime_error naming the file, as all functions
  explicit IndexedFile(std::filesystem::path file);
  ~IndexedFile();
  IndexedFile(const IndexedFile&) = delete;
  IndexedFile& operator=(const IndexedFile&) = delete;

  /// Ids; the same one for equals.
  std::uint16_t add(const Schema& schema);
  std::uint16_t add(const Channel& channel);
  /// @pre channel from `add`; called by increasing log time
  void add(const Message& message);
  void finish();

  [[nodiscard]] std::uint64_t num_messages() const { return num_messages_; }

 private:
  /// Content of a chunk, and what readers look up of it.
  struct Chunk {
    std::string records;
    Nanoseconds begin{};
    Nanoseconds end{};
    /// Log time and place in `records`, by channel.
    std::map<std::uint16_t, std::vector<std::pair<Nanoseconds, std::uint64_t>>> index;
  };

  void write(std::string_view bytes);
  void end_chunk();
  /// Statistics, and again all schemas and channels.
  [[nodiscard]] std::string summary() const;

  std::filesystem::path file_;
  std::filesystem::path temporary_;
  std::ofstream out_;
  std::uint64_t written_{};  ///< bytes
  std::map<Schema, std::uint16_t> schemas_;
  std::map<Channel, std::uint16_t> channels_;
  Chunk chunk_;
  std::string chunk_indices_;  ///< records
  std::uint32_t num_chunks_{};
  std::uint64_t num_messages_{};
  std::map<std::uint16_t, std::uint64_t> messages_of_;  ///< by channel
  std::pair<Nanoseconds, Nanoseconds> times_{};         ///< first and last
};

}  // namespace hlc::mcap
