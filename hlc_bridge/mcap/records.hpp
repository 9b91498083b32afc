#pragma once

#include <bit>
#include <concepts>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "hlc_bridge/messages/messages.hpp"

/// Records of the file format MCAP (https://mcap.dev/spec), version 0, as bytes.
///
///     record:  opcode (1 byte), length of the content (8 bytes), content
///
/// Numbers are little-endian; a text is its length (4 bytes) and its bytes.
namespace hlc::mcap {

static_assert(std::endian::native == std::endian::little);

inline constexpr std::string_view kMagic{"\x89MCAP0\r\n", 8};

enum class Opcode : std::uint8_t {
  kHeader = 0x01,
  kFooter = 0x02,
  kSchema = 0x03,
  kChannel = 0x04,
  kMessage = 0x05,
  kChunk = 0x06,
  kMessageIndex = 0x07,
  kChunkIndex = 0x08,
  kStatistics = 0x0B,
  kDataEnd = 0x0F,
};

/// How the messages of a channel are to be read.
struct Schema {
  std::string name;
  std::string encoding;  ///< "omgidl", "jsonschema"
  std::string text;

  friend auto operator<=>(const Schema&, const Schema&) = default;
};

/// Messages of one publisher on one topic.
struct Channel {
  std::uint16_t schema{};  ///< id, from 1
  std::string topic;
  std::string encoding;  ///< "cdr", "json"
  std::map<std::string, std::string> metadata;

  friend auto operator<=>(const Channel&, const Channel&) = default;
};

struct Message {
  std::uint16_t channel{};     ///< id
  std::uint32_t sequence{};    ///< among those of its channel
  Nanoseconds log_time{};      ///< time of the run
  Nanoseconds publish_time{};  ///< wall time
  std::string_view payload;
};

template <std::unsigned_integral T>
void append(std::string& bytes, T number) {
  bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
}
void append_text(std::string& bytes, std::string_view text);
void append_record(std::string& bytes, Opcode opcode, std::string_view content);

void append_header(std::string& bytes);
void append_schema(std::string& bytes, std::uint16_t id, const Schema& schema);
void append_channel(std::string& bytes, std::uint16_t id, const Channel& channel);
void append_message(std::string& bytes, const Message& message);
void append_data_end(std::string& bytes);
/// End of the data of a file without a summary, and the file's end.
void append_end(std::string& bytes);

/// A record as it lies in a file.
struct Record {
  Opcode opcode{};
  std::string_view content;
};

/// Takes the first record off `bytes`; nothing, and `bytes` unchanged, if it is not all there.
[[nodiscard]] std::optional<Record> take_record(std::string_view& bytes);

// The content of such a record; nothing if it is too short for its fields.
struct NumberedSchema {
  std::uint16_t id{};
  Schema schema;
};
struct NumberedChannel {
  std::uint16_t id{};
  Channel channel;
};
[[nodiscard]] std::optional<NumberedSchema> schema_in(std::string_view content);
[[nodiscard]] std::optional<NumberedChannel> channel_in(std::string_view content);
[[nodiscard]] std::optional<Message> message_in(std::string_view content);
/// The records of a chunk; nothing also if they are compressed.
[[nodiscard]] std::optional<std::string_view> records_in_chunk(std::string_view content);

}  // namespace hlc::mcap
