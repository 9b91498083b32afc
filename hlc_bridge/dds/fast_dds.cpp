#include "hlc_bridge/dds/fast_dds.hpp"

#include <dlfcn.h>

#include <cstdint>
#include <memory>
#include <mutex>
#include <type_traits>

#include <fastdds/rtps/builtin/data/ParticipantProxyData.h>
#include <fastdds/rtps/messages/MessageReceiver.h>
#include <fastdds/rtps/reader/StatefulReader.h>
#include <fastrtps/attributes/LibrarySettingsAttributes.h>
#include <fastrtps/config.h>
#include <fastrtps/types/DynamicDataFactory.h>
#include <fastrtps/types/DynamicTypeBuilderFactory.h>
#include <fastrtps/xmlparser/XMLProfileManager.h>
#include <fastdds/dds/log/Log.hpp>
#include <fastdds/dds/log/StdoutErrConsumer.hpp>

#if defined(__SANITIZE_ADDRESS__)
// Fast DDS 2.9 frees the pool of every writer and reader through a base class without virtual
// destructor: harmless, but the address sanitizer would end each of our processes at its first
// endpoint. The sanitizer asks this function for its options.
extern "C" const char* __asan_default_options();
extern "C" const char* __asan_default_options() { return "new_delete_type_mismatch=0"; }
#endif

// The functions of this namespace replace the library's of the same names.
namespace eprosima::fastrtps::rtps {
namespace {

template <class Function>
Function in_library(const char* symbol) {
  return reinterpret_cast<Function>(dlsym(RTLD_NEXT, symbol));
}

// For each message that a heartbeat or gap declares gone, the library takes a step of a loop, with
// the reader locked: after one forged datagram with the number 2^62 the process would receive
// nothing more, at full load of a processor. So many take it some seconds. Limit: a reader does not
// join a reliable writer that has published more than that, 93 hours at 50 messages a second.
constexpr std::int64_t kMostMissing = std::int64_t{1} << 24U;

bool is_plausible(StatefulReader& reader, const GUID_t& writer, const SequenceNumber_t& number) {
  static_assert(std::is_trivially_copyable_v<SequenceNumber_t>);
  static const auto kAvailableChangesMax = in_library<SequenceNumber_t (*)(const WriterProxy*)>(
      "_ZNK8eprosima8fastrtps4rtps11WriterProxy21available_changes_maxEv");
  const std::lock_guard lock(reader.getMutex());
  WriterProxy* proxy = nullptr;
  if (!reader.matched_writer_lookup(writer, &proxy)) return true;  // ignored by the library
  const auto in_64_bits = [](const SequenceNumber_t& one) {
    return static_cast<std::int64_t>(one.to64long());
  };
  return in_64_bits(number) <= in_64_bits(kAvailableChangesMax(proxy)) + kMostMissing;
}

}  // namespace

// Calls the library's. In 2.9 a participant that leaves keeps the flag for its lease check while it
// loses its name. The timer thread may be about to check the lease, and wait for the lock that the
// removal holds: an assertion, with which Debian builds the library, then ends the process without
// need.
void ParticipantProxyData::clear() {
  static const auto kLibraryClear = in_library<void (*)(ParticipantProxyData*)>(
      "_ZN8eprosima8fastrtps4rtps20ParticipantProxyData5clearEv");
  kLibraryClear(this);
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
  if (!is_plausible(*this, writer, first) || !is_plausible(*this, writer, last)) return false;
  static const auto kLibraryFunction =
      in_library<bool (*)(StatefulReader*, const GUID_t&, std::uint32_t, const SequenceNumber_t&,
                          const SequenceNumber_t&, bool, bool)>(
          "_ZN8eprosima8fastrtps4rtps14StatefulReader19processHeartbeatMsgERKNS1_6GUID_tEjRKNS1_16"
          "SequenceNumber_tES8_bb");
  return kLibraryFunction(this, writer, count, first, last, is_final, is_liveliness);
}

bool StatefulReader::processGapMsg(const GUID_t& writer, const SequenceNumber_t& start,
                                   const SequenceNumberSet_t& list) {
  if (!is_plausible(*this, writer, start) || !is_plausible(*this, writer, list.base()))
    return false;
  static const auto kLibraryFunction = in_library<bool (*)(
      StatefulReader*, const GUID_t&, const SequenceNumber_t&, const SequenceNumberSet_t&)>(
      "_ZN8eprosima8fastrtps4rtps14StatefulReader13processGapMsgERKNS1_6GUID_tERKNS1_16Sequence"
      "Number_tERKNS0_11BitmapRangeIS6_NS1_18SequenceNumberDiffELj256EEE");
  return kLibraryFunction(this, writer, start, list);
}

}  // namespace eprosima::fastrtps::rtps

namespace hlc::dds {

void log_library_errors() {
  fdds::Log::ClearConsumers();
  fdds::Log::RegisterConsumer(std::make_unique<fdds::StdoutErrConsumer>());
}

void turn_off_delivery_within_process() {
  eprosima::fastrtps::LibrarySettingsAttributes settings;
  settings.intraprocess_delivery = eprosima::fastrtps::INTRAPROCESS_OFF;
  eprosima::fastrtps::xmlparser::XMLProfileManager::library_settings(settings);
}

void make_type_factories() {
  static_cast<void>(eprosima::fastrtps::types::DynamicTypeBuilderFactory::get_instance());
  static_cast<void>(eprosima::fastrtps::types::DynamicDataFactory::get_instance());
}

std::string fast_dds_version() { return FASTRTPS_VERSION_STR; }

void DiscoveryListener::on_participant_discovery(fdds::DomainParticipant* /*own*/,
                                                 frtps::ParticipantDiscoveryInfo&& info) {
  using Info = frtps::ParticipantDiscoveryInfo;
  if (info.status == Info::CHANGED_QOS_PARTICIPANT) return;
  const auto& user_data = info.info.m_userData;
  on_found(FoundParticipant{.prefix = info.info.m_guid.guidPrefix,
                            .name = info.info.m_participantName.to_string(),
                            .user_data = std::string(user_data.begin(), user_data.end()),
                            .is_there = info.status == Info::DISCOVERED_PARTICIPANT});
}

void DiscoveryListener::on_subscriber_discovery(fdds::DomainParticipant* /*own*/,
                                                frtps::ReaderDiscoveryInfo&& info) {
  on_found(FoundEndpoint{.guid = info.info.guid(),
                         .topic = info.info.topicName().to_string(),
                         .is_writer = false,
                         .is_there = info.status != frtps::ReaderDiscoveryInfo::REMOVED_READER});
}

void DiscoveryListener::on_publisher_discovery(fdds::DomainParticipant* /*own*/,
                                               frtps::WriterDiscoveryInfo&& info) {
  on_found(FoundEndpoint{.guid = info.info.guid(),
                         .topic = info.info.topicName().to_string(),
                         .is_writer = true,
                         .is_there = info.status != frtps::WriterDiscoveryInfo::REMOVED_WRITER});
}

}  // namespace hlc::dds
