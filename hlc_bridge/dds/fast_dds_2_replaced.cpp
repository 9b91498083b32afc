#include "hlc_bridge/dds/fast_dds.hpp"

#include <dlfcn.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <type_traits>

#include <fastdds/rtps/builtin/data/ParticipantProxyData.h>
#include <fastdds/rtps/messages/MessageReceiver.h>
#include <fastdds/rtps/reader/StatefulReader.h>
#include <fastdds/rtps/reader/StatelessReader.h>
#include <fastrtps/config.h>
#include <fastdds/dds/log/Log.hpp>

#if defined(__SANITIZE_ADDRESS__)
// Fast DDS 2.9 frees the pool of every writer and reader through a base class without virtual
// destructor: harmless, but the address sanitizer would end each of our processes at its first
// endpoint. The sanitizer asks this function for its options.
extern "C" const char* __asan_default_options();
extern "C" const char* __asan_default_options() { return "new_delete_type_mismatch=0"; }
#endif

// The functions of this namespace replace the library's of the same names.
namespace eprosima::fastrtps::rtps {

namespace security {

/// As far as it is needed here: the library installs no header of it.
class SecurityManager {
 public:
  void match_builtin_endpoints(const ParticipantProxyData& participant);
  void match_builtin_key_exchange_endpoints(const ParticipantProxyData& participant);
};

}  // namespace security

namespace {

template <class Function>
Function in_library(const std::string& symbol) {
  void* address = dlsym(RTLD_NEXT, symbol.c_str());
  if (address == nullptr)
    throw std::runtime_error("Fast DDS " FASTRTPS_VERSION_STR ": the library has no function " +
                             symbol);
  return reinterpret_cast<Function>(address);
}

/// The library's own functions behind those that are replaced.
struct LibraryFunctions {
  void (*clear)(ParticipantProxyData*) =
      in_library<decltype(clear)>("_ZN8eprosima8fastrtps4rtps20ParticipantProxyData5clearEv");
  SequenceNumber_t (*available_changes_max)(const WriterProxy*) =
      in_library<decltype(available_changes_max)>(
          "_ZNK8eprosima8fastrtps4rtps11WriterProxy21available_changes_maxEv");
  bool (*heartbeat)(StatefulReader*, const GUID_t&, std::uint32_t, const SequenceNumber_t&,
                    const SequenceNumber_t&, bool, bool) =
      in_library<decltype(heartbeat)>(
          "_ZN8eprosima8fastrtps4rtps14StatefulReader19processHeartbeatMsgERKNS1_6GUID_tEjRKNS1_16"
          "SequenceNumber_tES8_bb");
  bool (*gap)(StatefulReader*, const GUID_t&, const SequenceNumber_t&, const SequenceNumberSet_t&) =
      in_library<decltype(gap)>(
          "_ZN8eprosima8fastrtps4rtps14StatefulReader13processGapMsgERKNS1_6GUID_tERKNS1_16Sequence"
          "Number_tERKNS0_11BitmapRangeIS6_NS1_18SequenceNumberDiffELj256EEE");
  bool (*data)(StatefulReader*, CacheChange_t*) = in_library<decltype(data)>(
      "_ZN8eprosima8fastrtps4rtps14StatefulReader14processDataMsgEPNS1_13CacheChange_tE");
  bool (*fragment)(StatefulReader*, CacheChange_t*, std::uint32_t, std::uint32_t, std::uint16_t) =
      in_library<decltype(fragment)>(
          "_ZN8eprosima8fastrtps4rtps14StatefulReader18processDataFragMsgEPNS1_13CacheChange_"
          "tEjjt");
  bool (*stateless_data)(StatelessReader*, CacheChange_t*) = in_library<decltype(stateless_data)>(
      "_ZN8eprosima8fastrtps4rtps15StatelessReader14processDataMsgEPNS1_13CacheChange_tE");
  bool (*stateless_fragment)(StatelessReader*, CacheChange_t*, std::uint32_t, std::uint32_t,
                             std::uint16_t) =
      in_library<decltype(stateless_fragment)>(
          "_ZN8eprosima8fastrtps4rtps15StatelessReader18processDataFragMsgEPNS1_13CacheChange_"
          "tEjjt");
  void (*match_endpoints)(security::SecurityManager*, const ParticipantProxyData&) =
      in_library<decltype(match_endpoints)>(
          "_ZN8eprosima8fastrtps4rtps8security15SecurityManager23match_builtin_endpointsERKNS1_20"
          "ParticipantProxyDataE");
  void (*match_key_exchange)(security::SecurityManager*, const ParticipantProxyData&) =
      in_library<decltype(match_key_exchange)>(
          "_ZN8eprosima8fastrtps4rtps8security15SecurityManager36match_builtin_key_exchange_"
          "endpointsERKNS1_20ParticipantProxyDataE");
};

const LibraryFunctions& library() {
  static const LibraryFunctions kFunctions;
  return kFunctions;
}

// For each message that a heartbeat or gap declares gone, the library takes a step of a loop, with
// the reader locked: after one forged datagram with the number 2^62 the process would receive
// nothing more, at full load of a processor. So many are a moment (README.md). 20 minutes at 50
// messages a second; a writer that stays away that long is lost, and matched again.
constexpr std::int64_t kMostMissing = std::int64_t{1} << 16U;
// While nothing was received of a writer: what it published before this reader joined. Once per
// writer and reader, as the number of the last message then rises. Limit: a reader does not join a
// reliable writer that has published more than that, 93 hours at 50 messages a second.
constexpr std::int64_t kMostBeforeJoining = std::int64_t{1} << 24U;

// What is announced above the last one received takes no such loop, and a late joiner receives a
// history in pieces: at most the reports of 10 000 steps about 30 vehicles (endpoint_qos.cpp).
constexpr std::int64_t kMostAnnounced = std::int64_t{1} << 20U;
// What a reliable reader stores of a writer before all earlier messages are there. Those beyond are
// sent again: without a bound, a peer that publishes faster than this process receives fills the
// memory, since of the reports alone the history has room for 10 000 of each vehicle. A writer
// whose message was lost sends so many at most, in logical time, until that is repaired (60 ms).
constexpr std::int64_t kMostUnordered = std::int64_t{1} << 8U;
// No program sends longer ones: a list of 255 vehicles has 50 kB. A message in fragments has its
// place in memory as soon as the first of them is there.
constexpr std::uint32_t kLongestMessage = std::uint32_t{1} << 18U;

// The library stores each number of a gap that is not the next one to come. A writer sends such
// gaps only within its history.
constexpr std::int64_t kLongestGapApart = std::int64_t{1} << 10U;

std::int64_t in_64_bits(const SequenceNumber_t& number) {
  return static_cast<std::int64_t>(number.to64long());
}

std::int64_t most_missing(std::int64_t last) {
  return last > 0 ? kMostMissing : kMostBeforeJoining;
}

std::int64_t most_announced(std::int64_t last) {
  return last > 0 ? kMostAnnounced : kMostBeforeJoining;
}

std::int64_t most_unordered(std::int64_t last) {
  return last > 0 ? kMostUnordered : kMostBeforeJoining;
}

/// Up to this one each message of the writer was received or is gone; none: the reader does not
/// know the writer, and the library ignores it.
std::optional<std::int64_t> last_received(StatefulReader& reader, const GUID_t& writer) {
  static_assert(std::is_trivially_copyable_v<SequenceNumber_t>);
  const std::lock_guard lock(reader.getMutex());
  WriterProxy* proxy = nullptr;
  if (!reader.matched_writer_lookup(writer, &proxy)) return std::nullopt;
  return in_64_bits(library().available_changes_max(proxy));
}

/// Once per process: whoever forges datagrams would fill the log.
bool is_first_dropped() {
  static std::atomic_flag is_logged;
  return !is_logged.test_and_set();
}

void log_dropped(const GUID_t& writer, std::int64_t number, std::int64_t last) {
  if (!is_first_dropped()) return;
  logError(RTPS_READER, "Dropped what declares message "
                            << number << " of writer " << writer << ": the last one received is "
                            << last << ". Further ones are dropped without a line.");
}

void log_dropped(const CacheChange_t& change) {
  if (!is_first_dropped()) return;
  logError(RTPS_READER, "Dropped what declares more bytes than it has, message "
                            << change.sequenceNumber << " of writer " << change.writerGUID
                            << ". Further ones are dropped without a line.");
}

/// @param most  above the last message received, given that one
bool is_plausible(StatefulReader& reader, const GUID_t& writer, const SequenceNumber_t& number,
                  std::int64_t (*most)(std::int64_t last)) {
  const auto last = last_received(reader, writer);
  if (!last || in_64_bits(number) <= *last + most(*last)) return true;
  log_dropped(writer, in_64_bits(number), *last);
  return false;
}

/// Nobody sends the messages of a best-effort writer again.
bool has_room(StatefulReader& reader, const CacheChange_t& change) {
  if (reader.getAttributes().reliabilityKind != RELIABLE) return true;
  const auto last = last_received(reader, change.writerGUID);
  return !last || in_64_bits(change.sequenceNumber) <= *last + most_unordered(*last);
}

/// The next messages of the writer do not wait for it.
void skip_message(StatefulReader& reader, const CacheChange_t& change) {
  if (is_first_dropped()) {
    logError(RTPS_READER, "Dropped message " << change.sequenceNumber << " of writer "
                                             << change.writerGUID << ": longer than "
                                             << kLongestMessage
                                             << " bytes. Further ones are dropped without a line.");
  }
  library().gap(&reader, change.writerGUID, change.sequenceNumber,
                SequenceNumberSet_t(change.sequenceNumber + 1));
}

// The library's loop begins at the begin of the gap, even if that is long past.
bool is_plausible_gap(StatefulReader& reader, const GUID_t& writer, std::int64_t begin,
                      std::int64_t end) {
  const auto last = last_received(reader, writer);
  if (!last) return true;
  const std::int64_t longest = begin <= *last + 1 ? most_missing(*last) : kLongestGapApart;
  const bool is_short =
      end <= begin || static_cast<std::uint64_t>(end) - static_cast<std::uint64_t>(begin) <=
                          static_cast<std::uint64_t>(longest);
  if (is_short && std::max(begin, end) <= *last + most_announced(*last)) return true;
  log_dropped(writer, std::max(begin, end), *last);
  return false;
}

/// The library computes the length in 32 bits without a sign from what the datagram declares: below
/// 0 it becomes one of nearly 4 GiB, which passes the library's check and is then copied. No
/// datagram has more than 64 KiB.
bool has_plausible_length(const CacheChange_t& change) {
  constexpr std::uint32_t kMost = std::uint32_t{1} << 20U;
  if (change.serializedPayload.length <= kMost) return true;
  log_dropped(change);
  return false;
}

/// The fragments lie within the message, and the datagram has all their bytes: the library copies
/// them unseen.
bool has_its_fragments(const CacheChange_t& change, std::uint64_t sample_size,
                       std::uint64_t first_fragment, std::uint64_t fragments) {
  if (!has_plausible_length(change)) return false;
  const std::uint64_t fragment_size = change.getFragmentSize();
  const std::uint64_t begin = (first_fragment - 1) * fragment_size;
  const std::uint64_t end = std::min(begin + fragments * fragment_size, sample_size);
  if (first_fragment > 0 && begin < end && change.serializedPayload.length >= end - begin)
    return true;
  log_dropped(change);
  return false;
}

}  // namespace

// Calls the library's. In 2.9 a participant that leaves keeps the flag for its lease check while it
// loses its name. The timer thread may be about to check the lease, and wait for the lock that the
// removal holds: an assertion, with which Debian builds the library, then ends the process without
// need.
void ParticipantProxyData::clear() {
  library().clear(this);
  should_check_lease_duration = false;
}

// Debian builds the library with statistics, which no program here reads, and with assertions: a
// datagram in which anything follows a statistics submessage, from whomever, would end the process.
// Without this function the submessage is skipped like any other of an unknown kind.
void MessageReceiver::notify_network_statistics(const Locator_t& /*source*/,
                                                const Locator_t& /*reception*/,
                                                CDRMessage_t* /*message*/) const {}

bool StatefulReader::processHeartbeatMsg(const GUID_t& writer, std::uint32_t count,
                                         const SequenceNumber_t& first,
                                         const SequenceNumber_t& last, bool is_final,
                                         bool is_liveliness) {
  if (!is_plausible(*this, writer, first, most_missing) ||
      !is_plausible(*this, writer, last, most_announced))
    return false;
  return library().heartbeat(this, writer, count, first, last, is_final, is_liveliness);
}

bool StatefulReader::processGapMsg(const GUID_t& writer, const SequenceNumber_t& start,
                                   const SequenceNumberSet_t& list) {
  if (!is_plausible_gap(*this, writer, in_64_bits(start), in_64_bits(list.base()))) return false;
  return library().gap(this, writer, start, list);
}

// After a message with the number 2^62 the library would count all before it as missing.
bool StatefulReader::processDataMsg(CacheChange_t* change) {
  if (!has_plausible_length(*change) ||
      !is_plausible(*this, change->writerGUID, change->sequenceNumber, most_announced) ||
      !has_room(*this, *change))
    return false;
  return library().data(this, change);
}

bool StatefulReader::processDataFragMsg(CacheChange_t* change, std::uint32_t sample_size,
                                        std::uint32_t first_fragment, std::uint16_t fragments) {
  if (!has_its_fragments(*change, sample_size, first_fragment, fragments) ||
      !is_plausible(*this, change->writerGUID, change->sequenceNumber, most_announced) ||
      !has_room(*this, *change))
    return false;
  if (sample_size > kLongestMessage) {
    skip_message(*this, *change);
    return false;
  }
  return library().fragment(this, change, sample_size, first_fragment, fragments);
}

// Those of discovery.
bool StatelessReader::processDataMsg(CacheChange_t* change) {
  return has_plausible_length(*change) && library().stateless_data(this, change);
}

bool StatelessReader::processDataFragMsg(CacheChange_t* change, std::uint32_t sample_size,
                                         std::uint32_t first_fragment, std::uint16_t fragments) {
  return has_its_fragments(*change, sample_size, first_fragment, fragments) &&
         library().stateless_fragment(this, change, sample_size, first_fragment, fragments);
}

namespace security {
namespace {

// Of all participants of the process. Neither function calls the other, and a thread that waits for
// such a lock holds none that its owner could wait for.
std::mutex endpoints_mutex;
std::mutex key_exchange_mutex;

}  // namespace

// The library describes the other participant in members that all its threads share. Two of them
// that find a participant each, at the same time, matched one of the two only: this process never
// read the other's authentication, and they did not meet.
void SecurityManager::match_builtin_endpoints(const ParticipantProxyData& participant) {
  const std::lock_guard lock(endpoints_mutex);
  library().match_endpoints(this, participant);
}

void SecurityManager::match_builtin_key_exchange_endpoints(
    const ParticipantProxyData& participant) {
  const std::lock_guard lock(key_exchange_mutex);
  library().match_key_exchange(this, participant);
}

}  // namespace security

}  // namespace eprosima::fastrtps::rtps

namespace hlc::dds {

void find_library_functions() { static_cast<void>(eprosima::fastrtps::rtps::library()); }

}  // namespace hlc::dds
