#pragma once

#include <filesystem>
#include <functional>

#include "hlc_bridge/mcap/records.hpp"

namespace hlc::mcap {

/// Reads all messages of a file that IndexedFile wrote, by log time.
/// @param take  receives them; payloads are valid during the call
/// @throws std::runtime_error naming the file: it cannot be read, is no MCAP file, is cut off, has
/// compressed chunks (another program wrote it), or its records contradict each other
void read_messages(const std::filesystem::path& file,
                   const std::function<void(const Channel&, const Message&)>& take);

}  // namespace hlc::mcap
