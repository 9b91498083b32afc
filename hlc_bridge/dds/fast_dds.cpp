#include "hlc_bridge/dds/fast_dds.hpp"

#include <dlfcn.h>

#include <memory>

#include <fastdds/rtps/builtin/data/ParticipantProxyData.h>
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

namespace eprosima::fastrtps::rtps {

// Replaces the library's function of that name, and calls it. In 2.9 a participant that leaves
// keeps the flag for its lease check while it loses its name. The timer thread may be about to
// check the lease, and wait for the lock that the removal holds: an assertion, with which Debian
// builds the library, then ends the process without need.
void ParticipantProxyData::clear() {
  using Clear = void (*)(ParticipantProxyData*);
  static const auto library_clear = reinterpret_cast<Clear>(
      dlsym(RTLD_NEXT, "_ZN8eprosima8fastrtps4rtps20ParticipantProxyData5clearEv"));
  library_clear(this);
  should_check_lease_duration = false;
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
