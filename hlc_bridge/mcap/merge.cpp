#include "hlc_bridge/mcap/merge.hpp"

#include <algorithm>
#include <map>
#include <stdexcept>
#include <string_view>
#include <tuple>

#include "hlc_bridge/mcap/indexed_file.hpp"
#include "hlc_bridge/mcap/mapped_file.hpp"
#include "hlc_bridge/mcap/records.hpp"

namespace hlc::mcap {
namespace {

/// Reads the parts, and keeps where their messages are.
class Messages {
 public:
  explicit Messages(IndexedFile& file) : file_(&file) {}

  /// @return whether the part ends as a closed recorder leaves it
  bool take_part(const std::filesystem::path& part) {
    if (std::filesystem::file_size(part) == 0) return false;  // killed before its first write
    std::string_view bytes = files_.emplace_back(part).bytes();
    if (!bytes.starts_with(kMagic)) throw std::runtime_error(part.string() + ": no MCAP file");
    bytes.remove_prefix(kMagic.size());
    std::map<std::uint16_t, std::uint16_t> schemas;
    std::map<std::uint16_t, std::uint16_t> channels;
    while (const std::optional<Record> record = take_record(bytes)) {
      if (record->opcode == Opcode::kFooter) return bytes == kMagic;
      if (!take(*record, schemas, channels)) {
        throw std::runtime_error(part.string() + ": a record contradicts the ones before it");
      }
    }
    return false;
  }
  void take(const JsonChannel& others) {
    const std::uint16_t schema =
        file_->add(Schema{.name = others.type, .encoding = "jsonschema", .text = others.schema});
    const std::uint16_t channel = file_->add(
        Channel{.schema = schema, .topic = others.topic, .encoding = "json", .metadata = {}});
    std::uint32_t sequence = 0;
    for (const auto& [time, text] : others.messages) {
      all_.push_back({channel, sequence++, time, time, text});
    }
  }

  [[nodiscard]] std::optional<Nanoseconds> first_time() const {
    if (all_.empty()) return std::nullopt;
    return std::ranges::min(all_, {}, &Message::log_time).log_time;
  }

  void write_sorted() {
    std::ranges::stable_sort(all_, {}, [](const Message& message) {
      return std::tuple(message.log_time, message.publish_time);
    });
    for (const Message& message : all_) file_->add(message);
  }

 private:
  using Ids = std::map<std::uint16_t, std::uint16_t>;  ///< in the file, by those of the part

  /// @return whether its ids are known
  bool take(const Record& record, Ids& schemas, Ids& channels) {
    switch (record.opcode) {
      case Opcode::kSchema: {
        const auto found = schema_in(record.content);
        if (found) schemas[found->id] = file_->add(found->schema);
        return found.has_value();
      }
      case Opcode::kChannel: {
        auto found = channel_in(record.content);
        if (!found || !schemas.contains(found->channel.schema)) return false;
        found->channel.schema = schemas.at(found->channel.schema);
        channels[found->id] = file_->add(found->channel);
        return true;
      }
      case Opcode::kMessage: {
        auto message = message_in(record.content);
        if (!message || !channels.contains(message->channel)) return false;
        message->channel = channels.at(message->channel);
        all_.push_back(*message);
        return true;
      }
      default:
        return true;
    }
  }

  IndexedFile* file_;
  std::vector<MappedFile> files_;
  std::vector<Message> all_;  ///< with views of the files
};

}  // namespace

Merged merge(const std::vector<std::filesystem::path>& parts, const OthersFrom& others_from,
             const std::filesystem::path& file) {
  IndexedFile merged(file);
  Messages messages(merged);
  Merged result;
  for (const std::filesystem::path& part : parts) {
    if (!messages.take_part(part)) result.cut_off.push_back(part);
  }
  const std::vector<JsonChannel> others = others_from(messages.first_time());
  for (const JsonChannel& channel : others) messages.take(channel);
  messages.write_sorted();
  merged.finish();
  result.num_messages = merged.num_messages();
  return result;
}

}  // namespace hlc::mcap
