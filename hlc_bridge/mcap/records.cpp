#include "hlc_bridge/mcap/records.hpp"

#include <cstring>

namespace hlc::mcap {
namespace {

std::string text_map(const std::map<std::string, std::string>& map) {
  std::string bytes;
  for (const auto& [key, value] : map) {
    append_text(bytes, key);
    append_text(bytes, value);
  }
  return bytes;
}

/// Reads the fields of a record one by one. Too few bytes: it has failed, and gives empty values.
class Fields {
 public:
  explicit Fields(std::string_view bytes) : bytes_(bytes) {}

  template <std::unsigned_integral T>
  T number() {
    T number{};
    const std::string_view bytes = take(sizeof number);
    if (!has_failed_) std::memcpy(&number, bytes.data(), sizeof number);
    return number;
  }
  std::string_view text() { return take(number<std::uint32_t>()); }
  std::map<std::string, std::string> map() {
    std::map<std::string, std::string> map;
    Fields entries(text());
    while (!entries.bytes_.empty() && !entries.has_failed_) {
      std::string key(entries.text());
      map.emplace(std::move(key), entries.text());
    }
    has_failed_ = has_failed_ || entries.has_failed_;
    return map;
  }
  std::string_view rest() { return take(bytes_.size()); }
  [[nodiscard]] bool has_failed() const { return has_failed_; }

 private:
  std::string_view take(std::size_t size) {
    has_failed_ = has_failed_ || size > bytes_.size();
    if (has_failed_) return {};
    const std::string_view taken = bytes_.substr(0, size);
    bytes_.remove_prefix(size);
    return taken;
  }

  std::string_view bytes_;
  bool has_failed_{};
};

}  // namespace

void append_text(std::string& bytes, std::string_view text) {
  append(bytes, static_cast<std::uint32_t>(text.size()));
  bytes.append(text);
}

void append_record(std::string& bytes, Opcode opcode, std::string_view content) {
  append(bytes, static_cast<std::uint8_t>(opcode));
  append(bytes, std::uint64_t{content.size()});
  bytes.append(content);
}

void append_header(std::string& bytes) {
  std::string content;
  append_text(content, "");     // profile: none
  append_text(content, "hlc");  // library
  append_record(bytes, Opcode::kHeader, content);
}

void append_schema(std::string& bytes, std::uint16_t id, const Schema& schema) {
  std::string content;
  append(content, id);
  append_text(content, schema.name);
  append_text(content, schema.encoding);
  append_text(content, schema.text);
  append_record(bytes, Opcode::kSchema, content);
}

void append_channel(std::string& bytes, std::uint16_t id, const Channel& channel) {
  std::string content;
  append(content, id);
  append(content, channel.schema);
  append_text(content, channel.topic);
  append_text(content, channel.encoding);
  append_text(content, text_map(channel.metadata));
  append_record(bytes, Opcode::kChannel, content);
}

void append_message(std::string& bytes, const Message& message) {
  constexpr std::uint64_t kHeadSize = 2 + 4 + 8 + 8;
  append(bytes, static_cast<std::uint8_t>(Opcode::kMessage));
  append(bytes, kHeadSize + message.payload.size());
  append(bytes, message.channel);
  append(bytes, message.sequence);
  append(bytes, message.log_time);
  append(bytes, message.publish_time);
  bytes.append(message.payload);
}

void append_data_end(std::string& bytes) {
  std::string no_checksum;
  append(no_checksum, std::uint32_t{0});
  append_record(bytes, Opcode::kDataEnd, no_checksum);
}

void append_end(std::string& bytes) {
  append_data_end(bytes);
  std::string footer;
  append(footer, std::uint64_t{0});  // no summary
  append(footer, std::uint64_t{0});  // no summary offsets
  append(footer, std::uint32_t{0});  // no checksum
  append_record(bytes, Opcode::kFooter, footer);
  bytes.append(kMagic);
}

std::optional<Record> take_record(std::string_view& bytes) {
  Fields fields(bytes);
  const auto opcode = fields.number<std::uint8_t>();
  const auto size = fields.number<std::uint64_t>();
  constexpr std::size_t kHeadSize = 1 + 8;
  if (fields.has_failed() || size > bytes.size() - kHeadSize) return std::nullopt;
  const Record record{Opcode{opcode}, bytes.substr(kHeadSize, size)};
  bytes.remove_prefix(kHeadSize + size);
  return record;
}

std::optional<NumberedSchema> schema_in(std::string_view content) {
  Fields fields(content);
  NumberedSchema found;
  found.id = fields.number<std::uint16_t>();
  found.schema.name = fields.text();
  found.schema.encoding = fields.text();
  found.schema.text = fields.text();
  if (fields.has_failed()) return std::nullopt;
  return found;
}

std::optional<NumberedChannel> channel_in(std::string_view content) {
  Fields fields(content);
  NumberedChannel found;
  found.id = fields.number<std::uint16_t>();
  found.channel.schema = fields.number<std::uint16_t>();
  found.channel.topic = fields.text();
  found.channel.encoding = fields.text();
  found.channel.metadata = fields.map();
  if (fields.has_failed()) return std::nullopt;
  return found;
}

std::optional<Message> message_in(std::string_view content) {
  Fields fields(content);
  Message message;
  message.channel = fields.number<std::uint16_t>();
  message.sequence = fields.number<std::uint32_t>();
  message.log_time = fields.number<std::uint64_t>();
  message.publish_time = fields.number<std::uint64_t>();
  message.payload = fields.rest();
  if (fields.has_failed()) return std::nullopt;
  return message;
}

std::optional<std::string_view> records_in_chunk(std::string_view content) {
  Fields fields(content);
  static_cast<void>(fields.number<std::uint64_t>());  // first log time
  static_cast<void>(fields.number<std::uint64_t>());  // last
  static_cast<void>(fields.number<std::uint64_t>());  // size
  static_cast<void>(fields.number<std::uint32_t>());  // checksum
  const bool is_compressed = !fields.text().empty();
  const auto size = fields.number<std::uint64_t>();
  const std::string_view records = fields.rest();
  if (fields.has_failed() || is_compressed || records.size() != size) return std::nullopt;
  return records;
}

}  // namespace hlc::mcap
