#include "hlc_bridge/mcap/indexed_file.hpp"

#include <unistd.h>

#include <algorithm>
#include <boost/crc.hpp>
#include <limits>
#include <stdexcept>

namespace hlc::mcap {
namespace {

constexpr std::size_t kChunkSize = 1 << 20;  ///< bytes: what a reader loads to show one moment

std::uint32_t checksum(std::string_view bytes) {
  boost::crc_32_type crc;
  crc.process_bytes(bytes.data(), bytes.size());
  return crc.checksum();
}

/// The id of `value`, and whether it is new.
template <class Value>
std::pair<std::uint16_t, bool> numbered(std::map<Value, std::uint16_t>& known, const Value& value) {
  if (known.size() == std::numeric_limits<std::uint16_t>::max()) {
    throw std::runtime_error("more than 65535 channels");
  }
  const auto [found, is_new] =
      known.try_emplace(value, static_cast<std::uint16_t>(known.size() + 1));
  return {found->second, is_new};
}

std::string lookup_table(const std::vector<std::pair<Nanoseconds, std::uint64_t>>& entries) {
  std::string bytes;
  for (const auto& [time, offset] : entries) {
    append(bytes, time);
    append(bytes, offset);
  }
  return bytes;
}

}  // namespace

IndexedFile::IndexedFile(std::filesystem::path file)
    : file_(std::move(file)), temporary_(file_.string() + "." + std::to_string(getpid())) {
  out_.open(temporary_, std::ios::binary | std::ios::trunc);
  std::string bytes(kMagic);
  append_header(bytes);
  write(bytes);
}

IndexedFile::~IndexedFile() {
  std::error_code ignored;
  std::filesystem::remove(temporary_, ignored);
}

std::uint16_t IndexedFile::add(const Schema& schema) {
  const auto [id, is_new] = numbered(schemas_, schema);
  if (is_new) append_schema(chunk_.records, id, schema);
  return id;
}

std::uint16_t IndexedFile::add(const Channel& channel) {
  const auto [id, is_new] = numbered(channels_, channel);
  if (is_new) append_channel(chunk_.records, id, channel);
  return id;
}

void IndexedFile::add(const Message& message) {
  if (chunk_.index.empty()) chunk_.begin = message.log_time;
  chunk_.end = message.log_time;
  chunk_.index[message.channel].emplace_back(message.log_time, chunk_.records.size());
  append_message(chunk_.records, message);
  if (num_messages_ == 0) times_.first = message.log_time;
  times_.second = message.log_time;
  ++num_messages_;
  ++messages_of_[message.channel];
  if (chunk_.records.size() >= kChunkSize) end_chunk();
}

void IndexedFile::end_chunk() {
  if (chunk_.records.empty()) return;
  std::string content;
  append(content, chunk_.begin);
  append(content, chunk_.end);
  append(content, std::uint64_t{chunk_.records.size()});
  append(content, checksum(chunk_.records));
  append_text(content, "");  // not compressed
  append(content, std::uint64_t{chunk_.records.size()});
  content += chunk_.records;
  const std::uint64_t chunk_start = written_;
  std::string bytes;
  append_record(bytes, Opcode::kChunk, content);
  const std::uint64_t chunk_length = bytes.size();

  std::string offsets;
  for (const auto& [channel, entries] : chunk_.index) {
    append(offsets, channel);
    append(offsets, std::uint64_t{chunk_start + bytes.size()});
    std::string index;
    append(index, channel);
    append_text(index, lookup_table(entries));
    append_record(bytes, Opcode::kMessageIndex, index);
  }
  write(bytes);

  std::string of_chunk;
  append(of_chunk, chunk_.begin);
  append(of_chunk, chunk_.end);
  append(of_chunk, chunk_start);
  append(of_chunk, chunk_length);
  append_text(of_chunk, offsets);
  append(of_chunk, std::uint64_t{bytes.size() - chunk_length});
  append_text(of_chunk, "");
  append(of_chunk, std::uint64_t{chunk_.records.size()});
  append(of_chunk, std::uint64_t{chunk_.records.size()});
  append_record(chunk_indices_, Opcode::kChunkIndex, of_chunk);
  ++num_chunks_;
  chunk_ = {};
}

std::string IndexedFile::summary() const {
  std::string bytes;
  for (const auto& [schema, id] : schemas_) append_schema(bytes, id, schema);
  for (const auto& [channel, id] : channels_) append_channel(bytes, id, channel);
  std::string statistics;
  append(statistics, num_messages_);
  append(statistics, static_cast<std::uint16_t>(schemas_.size()));
  append(statistics, static_cast<std::uint32_t>(channels_.size()));
  append(statistics, std::uint32_t{0});  // attachments
  append(statistics, std::uint32_t{0});  // metadata
  append(statistics, num_chunks_);
  append(statistics, times_.first);
  append(statistics, times_.second);
  std::string counts;
  for (const auto& [channel, count] : messages_of_) {
    append(counts, channel);
    append(counts, count);
  }
  append_text(statistics, counts);
  append_record(bytes, Opcode::kStatistics, statistics);
  return bytes + chunk_indices_;
}

void IndexedFile::finish() {
  end_chunk();
  std::string bytes;
  append_data_end(bytes);
  const std::uint64_t summary_start = written_ + bytes.size();
  const std::string text = summary();
  bytes += text;

  // The checksum is of all from the summary's begin to the footer's last field before it.
  std::string footer;
  append(footer, summary_start);
  append(footer, std::uint64_t{0});  // no summary offsets
  std::string footer_record;
  append_record(footer_record, Opcode::kFooter, footer + std::string(4, '\0'));
  footer_record.resize(footer_record.size() - 4);
  append(footer_record, checksum(text + footer_record));
  write(bytes + footer_record + std::string(kMagic));
  out_.close();
  if (!out_) throw std::runtime_error(file_.string() + ": cannot be written");
  std::filesystem::rename(temporary_, file_);
}

void IndexedFile::write(std::string_view bytes) {
  out_.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!out_) throw std::runtime_error(file_.string() + ": cannot be written");
  written_ += bytes.size();
}

}  // namespace hlc::mcap
