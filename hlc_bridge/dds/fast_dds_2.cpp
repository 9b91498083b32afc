#include <memory>
#include <string>

#include <fastrtps/attributes/LibrarySettingsAttributes.h>
#include <fastrtps/config.h>
#include <fastrtps/types/DynamicDataFactory.h>
#include <fastrtps/types/DynamicTypeBuilderFactory.h>
#include <fastrtps/types/TypeObjectFactory.h>
#include <fastrtps/xmlparser/XMLProfileManager.h>
#include <fastdds/dds/log/Log.hpp>
#include <fastdds/dds/log/StdoutErrConsumer.hpp>

#include "hlc_bridge/dds/fast_dds.hpp"

// With Fast DDS 2.9. The functions of the library that are replaced: fast_dds_2_replaced.cpp.
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

bool knows_type_object(const std::string& type_name) {
  return eprosima::fastrtps::types::TypeObjectFactory::get_instance()->get_type_object(
             type_name, true) != nullptr;
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

void DiscoveryListener::onParticipantAuthentication(fdds::DomainParticipant* /*own*/,
                                                    frtps::ParticipantAuthenticationInfo&& info) {
  if (info.status == frtps::ParticipantAuthenticationInfo::AUTHORIZED_PARTICIPANT) {
    on_authenticated(info.guid.guidPrefix);
  } else {
    on_refused(info.guid.guidPrefix);
  }
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
