#include "hlc_bridge/mcap/recorded_messages.hpp"

#include <map>
#include <stdexcept>
#include <string>

#include "hlc_bridge/mcap/mapped_file.hpp"

namespace hlc::mcap {
namespace {

class Reader {
 public:
  Reader(const std::filesystem::path& file,
         const std::function<void(const Channel&, const Message&)>& take)
      : file_(file), take_(take) {}

  /// @return whether the data ends here
  bool take(const Record& record) {
    if (record.opcode == Opcode::kDataEnd) return true;
    if (record.opcode != Opcode::kChunk) return false;
    std::optional<std::string_view> records = records_in_chunk(record.content);
    if (!records) refuse("a chunk is compressed or too short");
    while (const std::optional<Record> one = take_record(*records)) take_in_chunk(*one);
    if (!records->empty()) refuse("a record in a chunk is cut off");
    return false;
  }

  [[noreturn]] void refuse(const std::string& what) const {
    throw std::runtime_error(file_.string() + ": " + what);
  }

 private:
  void take_in_chunk(const Record& record) {
    if (record.opcode == Opcode::kChannel) {
      const std::optional<NumberedChannel> found = channel_in(record.content);
      if (!found) refuse("a channel is cut off");
      channels_[found->id] = found->channel;
    } else if (record.opcode == Opcode::kMessage) {
      const std::optional<Message> message = message_in(record.content);
      if (!message || !channels_.contains(message->channel)) {
        refuse("a message has no channel before it");
      }
      take_(channels_.at(message->channel), *message);
    }
  }

  const std::filesystem::path& file_;
  const std::function<void(const Channel&, const Message&)>& take_;
  std::map<std::uint16_t, Channel> channels_;
};

}  // namespace

void read_messages(const std::filesystem::path& file,
                   const std::function<void(const Channel&, const Message&)>& take) {
  Reader reader(file, take);
  if (std::filesystem::exists(file) && std::filesystem::file_size(file) == 0) {
    reader.refuse("no MCAP file");  // an empty file cannot be mapped
  }
  const MappedFile mapped(file);
  std::string_view bytes = mapped.bytes();
  if (!bytes.starts_with(kMagic)) reader.refuse("no MCAP file");
  bytes.remove_prefix(kMagic.size());
  while (const std::optional<Record> record = take_record(bytes)) {
    if (reader.take(*record)) return;
  }
  reader.refuse("cut off: it has no end of its data");
}

}  // namespace hlc::mcap
