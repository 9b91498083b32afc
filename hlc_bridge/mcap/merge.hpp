#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "hlc_bridge/messages/messages.hpp"

namespace hlc::mcap {

/// Messages in JSON that are added to those recorded, by time.
struct JsonChannel {
  std::string topic;
  std::string type;    ///< name of the schema
  std::string schema;  ///< JSON schema
  std::vector<std::pair<Nanoseconds, std::string>> messages;
};

struct Merged {
  std::size_t num_messages{};
  /// Parts that do not end as a closed recorder leaves them: of a process that was killed, or that
  /// still publishes. Of them all whole messages are taken.
  std::vector<std::filesystem::path> cut_off;
};

/// The messages to add to a recording whose first message is of this time; nothing: it has none.
using OthersFrom =
    std::function<std::vector<JsonChannel>(std::optional<Nanoseconds> recorded_from)>;

/// Writes one indexed file with the messages of all parts (MessageRecorder), by time of the run,
/// then by wall time.
/// @throws std::runtime_error naming a part that is no MCAP file or contradicts itself, and the
/// file that cannot be read or written
Merged merge(const std::vector<std::filesystem::path>& parts, const OthersFrom& others_from,
             const std::filesystem::path& file);

}  // namespace hlc::mcap
