#include "hlc_bridge/dds/participant_core.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include <fastdds/dds/domain/DomainParticipantFactory.hpp>

#include "hlc_bridge/dds/endpoint_peers.hpp"
#include "hlc_bridge/dds/library.hpp"
#include "hlc_bridge/dds/participant_qos.hpp"

namespace hlc {
namespace {

ParticipantKey key_of(const frtps::GuidPrefix_t& prefix) {
  ParticipantKey key{};
  std::copy(std::begin(prefix.value), std::end(prefix.value), key.begin());
  return key;
}

[[noreturn]] void refuse(const ParticipantOptions& options, const std::string& what) {
  throw std::runtime_error("participant " + options.name + " on domain " +
                           std::to_string(options.domain_id) + ": " + what);
}

}  // namespace

ParticipantCore::ParticipantCore(const ParticipantOptions& options,
                                 std::function<void()> on_presence_change)
    : options_{options}, on_presence_change_{std::move(on_presence_change)} {
  check_domain_id("domain of participant " + options_.name, options_.domain_id);
  if (options_.name.empty() || options_.name.size() > kMaxParticipantName) {
    throw std::invalid_argument("participant name \"" + options_.name + "\": 1 to " +
                                std::to_string(kMaxParticipantName) + " characters are allowed");
  }
  const fdds::DomainParticipantQos qos = participant_qos(options_);
  set_up_library();
  participant_ = fdds::DomainParticipantFactory::get_instance()->create_participant(
      static_cast<fdds::DomainId_t>(options_.domain_id), qos, this, fdds::StatusMask::none());
  if (participant_ == nullptr) {
    refuse(options_, "the library could not create it (too many participants on this host?)");
  }
  publisher_ = participant_->create_publisher(fdds::PUBLISHER_QOS_DEFAULT);
  subscriber_ = participant_->create_subscriber(fdds::SUBSCRIBER_QOS_DEFAULT);
}

ParticipantCore::~ParticipantCore() {
  close();
  participant_->set_listener(nullptr);
  participant_->delete_contained_entities();
  fdds::DomainParticipantFactory::get_instance()->delete_participant(participant_);
}

fdds::Topic& ParticipantCore::topic(const std::string& name, const fdds::TypeSupport& type) {
  const std::lock_guard lock{topics_mutex_};
  fdds::Topic*& topic = topics_[name];
  if (topic == nullptr) {
    if (participant_->find_type(type.get_type_name()).empty() &&
        type.register_type(participant_) != eprosima::fastrtps::types::ReturnCode_t::RETCODE_OK) {
      refuse(options_, "type " + type.get_type_name() + " could not be registered");
    }
    topic = participant_->create_topic(name, type.get_type_name(), fdds::TOPIC_QOS_DEFAULT);
  }
  if (topic == nullptr) {
    refuse(options_, "topic " + name + " could not be created");
  }
  return *topic;
}

bool ParticipantCore::is_own(const frtps::GUID_t& endpoint) const {
  return endpoint.guidPrefix == participant_->guid().guidPrefix;
}

std::set<frtps::GUID_t> ParticipantCore::discovered(PeerKind kind, const std::string& topic) const {
  const auto found = discovered_.find({kind, topic});
  return found == discovered_.end() ? std::set<frtps::GUID_t>{} : found->second;
}

void ParticipantCore::add_peers(const std::shared_ptr<EndpointPeers>& peers) {
  const std::lock_guard lock{mutex_};
  std::erase_if(endpoints_, [](const auto& endpoint) { return endpoint.expired(); });
  endpoints_.push_back(peers);
}

void ParticipantCore::on_participant_discovery(fdds::DomainParticipant*,
                                               frtps::ParticipantDiscoveryInfo&& info) {
  using Info = frtps::ParticipantDiscoveryInfo;
  if (info.status == Info::CHANGED_QOS_PARTICIPANT) {
    return;
  }
  const ParticipantKey key = key_of(info.info.m_guid.guidPrefix);
  const std::string name = info.info.m_participantName.to_string();
  const auto& data = info.info.m_userData;
  const std::string version(data.begin(), data.end());
  const bool is_there = info.status == Info::DISCOVERED_PARTICIPANT;
  const auto endpoints = update([&] {
    is_there ? presence_.appeared(key, name, version) : presence_.left(key);
    return endpoints_;
  });
  presence_gate_.enter([&] {
    if (on_presence_change_) {
      on_presence_change_();
    }
  });
  for (const auto& endpoint : endpoints) {
    if (const auto peers = endpoint.lock()) {
      peers->notify();
    }
  }
}

void ParticipantCore::on_subscriber_discovery(fdds::DomainParticipant*,
                                              frtps::ReaderDiscoveryInfo&& info) {
  on_endpoint(PeerKind::kReader, info.status != frtps::ReaderDiscoveryInfo::REMOVED_READER,
              info.info.guid(), info.info.topicName().to_string());
}

void ParticipantCore::on_publisher_discovery(fdds::DomainParticipant*,
                                             frtps::WriterDiscoveryInfo&& info) {
  on_endpoint(PeerKind::kWriter, info.status != frtps::WriterDiscoveryInfo::REMOVED_WRITER,
              info.info.guid(), info.info.topicName().to_string());
}

void ParticipantCore::on_endpoint(PeerKind kind, bool is_there, const frtps::GUID_t& guid,
                                  const std::string& topic) {
  update([&] {
    auto& endpoints = discovered_[{kind, topic}];
    if (is_there) {
      endpoints.insert(guid);
    } else {
      endpoints.erase(guid);
    }
  });
}

}  // namespace hlc
