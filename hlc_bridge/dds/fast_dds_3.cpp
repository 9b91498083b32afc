#include <memory>
#include <string>

#include <fastdds/LibrarySettings.hpp>
#include <fastdds/config.hpp>
#include <fastdds/dds/log/Log.hpp>
#include <fastdds/dds/log/StdoutErrConsumer.hpp>
#include <fastdds/dds/xtypes/type_representation/ITypeObjectRegistry.hpp>

#include "hlc_bridge/dds/fast_dds.hpp"
#include "hlc_bridge/dds/register_lab_types.hpp"

// With Fast DDS 3. None of its functions is replaced (README.md).
namespace hlc::dds {

void find_library_functions() {}

void log_library_errors() {
  fdds::Log::ClearConsumers();
  fdds::Log::RegisterConsumer(std::make_unique<fdds::StdoutErrConsumer>());
}

void turn_off_delivery_within_process() {
  eprosima::fastdds::LibrarySettings settings;
  settings.intraprocess_delivery = eprosima::fastdds::INTRAPROCESS_OFF;
  fdds::DomainParticipantFactory::get_instance()->set_library_settings(settings);
}

// Discovery makes none.
void make_type_factories() {}

// Only a type that is used needs its type object, and a topic registers it.
void register_lab_types() {}

bool knows_type_object(const std::string& type_name) {
  fdds::xtypes::TypeObjectPair type_objects;
  return is_ok(
      fdds::DomainParticipantFactory::get_instance()->type_object_registry().get_type_objects(
          type_name, type_objects));
}

std::string fast_dds_version() { return FASTDDS_VERSION_STR; }

void DiscoveryListener::on_participant_discovery(fdds::DomainParticipant* /*own*/,
                                                 frtps::ParticipantDiscoveryStatus status,
                                                 const fdds::ParticipantBuiltinTopicData& info,
                                                 bool& /*is_ignored*/) {
  using Status = frtps::ParticipantDiscoveryStatus;
  if (status == Status::CHANGED_QOS_PARTICIPANT) return;
  const auto& user_data = info.user_data.data_vec();
  on_found(FoundParticipant{.prefix = info.guid.guidPrefix,
                            .name = info.participant_name.to_string(),
                            .user_data = std::string(user_data.begin(), user_data.end()),
                            .is_there = status == Status::DISCOVERED_PARTICIPANT});
}

#if HAVE_SECURITY
void DiscoveryListener::onParticipantAuthentication(fdds::DomainParticipant* /*own*/,
                                                    frtps::ParticipantAuthenticationInfo&& info) {
  if (info.status == frtps::ParticipantAuthenticationInfo::AUTHORIZED_PARTICIPANT) {
    on_authenticated(info.guid.guidPrefix);
  } else {
    on_refused(info.guid.guidPrefix);
  }
}
#endif

void DiscoveryListener::on_data_reader_discovery(fdds::DomainParticipant* /*own*/,
                                                 frtps::ReaderDiscoveryStatus status,
                                                 const fdds::SubscriptionBuiltinTopicData& info,
                                                 bool& /*is_ignored*/) {
  on_found(FoundEndpoint{.guid = info.guid,
                         .topic = info.topic_name.to_string(),
                         .is_writer = false,
                         .is_there = status != frtps::ReaderDiscoveryStatus::REMOVED_READER});
}

void DiscoveryListener::on_data_writer_discovery(fdds::DomainParticipant* /*own*/,
                                                 frtps::WriterDiscoveryStatus status,
                                                 const fdds::PublicationBuiltinTopicData& info,
                                                 bool& /*is_ignored*/) {
  on_found(FoundEndpoint{.guid = info.guid,
                         .topic = info.topic_name.to_string(),
                         .is_writer = true,
                         .is_there = status != frtps::WriterDiscoveryStatus::REMOVED_WRITER});
}

}  // namespace hlc::dds
