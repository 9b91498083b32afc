#include "tests/hlc_bridge/mcap/mcap_reader.hpp"

#include <fmt/format.h>

#include <cstring>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "planner/common/text_file.hpp"

namespace hlc::test {
namespace {

void demand(bool is_right, const std::string& what) {
  if (!is_right) throw std::runtime_error(what);
}

class Bytes {
 public:
  explicit Bytes(std::string_view bytes) : bytes_(bytes) {}
  template <class T>
  T number() {
    T value{};
    std::memcpy(&value, take(sizeof value).data(), sizeof value);
    return value;
  }
  std::string_view take(std::size_t size) {
    demand(size <= bytes_.size(), "a record is too short");
    const std::string_view taken = bytes_.substr(0, size);
    bytes_.remove_prefix(size);
    return taken;
  }
  std::string text() { return std::string(take(number<std::uint32_t>())); }
  [[nodiscard]] bool empty() const { return bytes_.empty(); }
  [[nodiscard]] std::size_t size() const { return bytes_.size(); }

 private:
  std::string_view bytes_;
};

/// CRC-32 of ISO 3309, bit by bit.
std::uint32_t crc32(std::string_view bytes) {
  std::uint32_t crc = 0xFFFF'FFFF;
  for (const char byte : bytes) {
    crc ^= static_cast<unsigned char>(byte);
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ ((crc & 1) != 0 ? 0xEDB8'8320 : 0);
  }
  return ~crc;
}

struct Tables {
  std::map<std::uint16_t, std::string> types;
  struct Channel {
    std::string topic;
    std::string type;
    std::map<std::string, std::string> metadata;
  };
  std::map<std::uint16_t, Channel> channels;

  void take(std::uint8_t opcode, Bytes content) {
    const auto id = content.number<std::uint16_t>();
    if (opcode == 0x03) {
      types[id] = content.text();
    } else {
      const auto schema = content.number<std::uint16_t>();
      Channel& channel = channels[id];
      channel.type = types.at(schema);
      channel.topic = content.text();
      content.text();  // encoding
      Bytes map(content.take(content.number<std::uint32_t>()));
      while (!map.empty()) {
        const std::string key = map.text();
        channel.metadata[key] = map.text();
      }
    }
  }
  [[nodiscard]] McapMessage message(Bytes content) const {
    const Channel& channel = channels.at(content.number<std::uint16_t>());
    McapMessage message{
        .topic = channel.topic, .type = channel.type, .metadata = channel.metadata, .payload = {}};
    message.sequence = content.number<std::uint32_t>();
    message.log_time = content.number<std::uint64_t>();
    message.publish_time = content.number<std::uint64_t>();
    message.payload = content.take(content.size());
    return message;
  }
};

struct ChunkIndex {
  std::uint64_t begin{};
  std::uint64_t end{};
  std::uint64_t start{};
  std::map<std::uint16_t, std::uint64_t> message_indices;
};

struct Summary {
  Tables tables;
  std::vector<ChunkIndex> chunks;
  std::uint64_t num_messages{};
};

ChunkIndex chunk_index(Bytes content) {
  ChunkIndex index;
  index.begin = content.number<std::uint64_t>();
  index.end = content.number<std::uint64_t>();
  index.start = content.number<std::uint64_t>();
  content.number<std::uint64_t>();  // length
  Bytes map(content.take(content.number<std::uint32_t>()));
  while (!map.empty()) {
    const auto channel = map.number<std::uint16_t>();
    index.message_indices[channel] = map.number<std::uint64_t>();
  }
  return index;
}

constexpr std::size_t kFooterSize = 1 + 8 + 8 + 8 + 4;
constexpr std::string_view kMagic{"\x89MCAP0\r\n", 8};

Summary read_summary(std::string_view file) {
  demand(file.starts_with(kMagic) && file.ends_with(kMagic), "no MCAP file");
  const std::size_t footer_at = file.size() - kMagic.size() - kFooterSize;
  Bytes footer(file.substr(footer_at + 9, kFooterSize - 9));
  demand(file[footer_at] == 0x02, "no footer");
  const auto start = footer.number<std::uint64_t>();
  footer.number<std::uint64_t>();
  demand(footer.number<std::uint32_t>() ==
             crc32(file.substr(start, footer_at + kFooterSize - 4 - start)),
         "checksum of the summary");
  Summary summary;
  Bytes records(file.substr(start, footer_at - start));
  while (!records.empty()) {
    const auto opcode = records.number<std::uint8_t>();
    Bytes content(records.take(records.number<std::uint64_t>()));
    if (opcode == 0x03 || opcode == 0x04) summary.tables.take(opcode, content);
    if (opcode == 0x08) summary.chunks.push_back(chunk_index(content));
    if (opcode == 0x0B) summary.num_messages = content.number<std::uint64_t>();
  }
  return summary;
}

/// The records of a chunk.
std::string_view records_at(std::string_view file, const ChunkIndex& index) {
  Bytes bytes(file.substr(index.start));
  demand(bytes.number<std::uint8_t>() == 0x06, "no chunk where the index has it");
  bytes.number<std::uint64_t>();
  demand(bytes.number<std::uint64_t>() == index.begin, "begin of a chunk");
  demand(bytes.number<std::uint64_t>() == index.end, "end of a chunk");
  const auto size = bytes.number<std::uint64_t>();
  const auto crc = bytes.number<std::uint32_t>();
  demand(bytes.text().empty(), "compression");
  const std::string_view records = bytes.take(bytes.number<std::uint64_t>());
  demand(records.size() == size && crc32(records) == crc, "checksum of a chunk");
  return records;
}

}  // namespace

std::vector<McapMessage> read_by_index(const std::filesystem::path& path) {
  const std::string file = read_file(path);
  const Summary summary = read_summary(file);
  std::vector<McapMessage> messages;
  for (const ChunkIndex& chunk : summary.chunks) {
    const std::string_view records = records_at(file, chunk);
    std::map<std::uint64_t, McapMessage> found;  // by place
    for (const auto& [channel, place] : chunk.message_indices) {
      Bytes index(std::string_view(file).substr(place));
      demand(index.number<std::uint8_t>() == 0x07, "no message index where the chunk's has it");
      index.number<std::uint64_t>();
      demand(index.number<std::uint16_t>() == channel, "channel of a message index");
      Bytes entries(index.take(index.number<std::uint32_t>()));
      while (!entries.empty()) {
        const auto time = entries.number<std::uint64_t>();
        const auto offset = entries.number<std::uint64_t>();
        Bytes record(records.substr(offset));
        demand(record.number<std::uint8_t>() == 0x05, "no message where the index has it");
        const auto size = record.number<std::uint64_t>();
        found[offset] = summary.tables.message(Bytes(record.take(size)));
        demand(found[offset].log_time == time, "time of a message");
        demand(time >= chunk.begin && time <= chunk.end, "times of a chunk");
      }
    }
    for (auto& [offset, message] : found) messages.push_back(std::move(message));
  }
  demand(messages.size() == summary.num_messages, "number of messages");
  return messages;
}

std::vector<McapMessage> read_from_begin(const std::filesystem::path& path) {
  const std::string file = read_file(path);
  demand(file.starts_with(kMagic), "no MCAP file");
  std::string_view rest = std::string_view(file).substr(kMagic.size());
  Tables tables;
  std::vector<McapMessage> messages;
  while (rest.size() > 9) {
    Bytes head(rest);
    const auto opcode = head.number<std::uint8_t>();
    const auto size = head.number<std::uint64_t>();
    if (size > rest.size() - 9) break;
    const Bytes content(rest.substr(9, size));
    if (opcode == 0x03 || opcode == 0x04) tables.take(opcode, content);
    if (opcode == 0x05) messages.push_back(tables.message(content));
    if (opcode == 0x02) break;
    rest.remove_prefix(9 + size);
  }
  return messages;
}

}  // namespace hlc::test
