#include "hlc_bridge/dds/participant_core.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "hlc_bridge/dds/endpoint_peers.hpp"
#include "hlc_bridge/dds/library.hpp"
#include "hlc_bridge/dds/participant_qos.hpp"
#include "hlc_bridge/dds/security.hpp"

namespace hlc::dds {
namespace {

[[noreturn]] void refuse_participant(const ParticipantOptions& options, const std::string& what) {
  throw std::runtime_error(
      fmt::format("participant {} on domain {}: {}", options.name, options.domain_id, what));
}

/// The library ends the process, or has no sockets, if it gets no descriptor. A participant takes 8
/// with one network interface (measured: 5 sockets, 3 others; 4 on the local domain with shared
/// memory). The rest is for further interfaces and for what the process opens later.
void check_free_descriptors(const ParticipantOptions& options) {
  constexpr int kNeeded = 20;
  rlimit limit{};
  ::getrlimit(RLIMIT_NOFILE, &limit);
  int num_free = 0;
  for (int file = 0; static_cast<rlim_t>(file) < limit.rlim_cur && num_free < kNeeded; ++file) {
    if (::fcntl(file, F_GETFD) < 0) ++num_free;
  }
  if (num_free == kNeeded) return;
  refuse_participant(
      options, fmt::format("free file descriptors must be >= {}, got {} (ulimit -n {})", kNeeded,
                           num_free, limit.rlim_cur));
}

}  // namespace

ParticipantKey key_of(const frtps::GuidPrefix_t& prefix) {
  ParticipantKey key{};
  std::copy(std::begin(prefix.value), std::end(prefix.value), key.begin());
  return key;
}

ParticipantCore::ParticipantCore(const ParticipantOptions& options,
                                 std::function<void()> on_presence_change)
    : options_{options}, on_presence_change_{std::move(on_presence_change)} {
  check_domain_id("domain of participant " + options_.name, options_.domain_id);
  if (options_.name.empty() || options_.name.size() > kMaxParticipantName) {
    throw std::invalid_argument(fmt::format("participant name \"{}\" must have 1 ... {} characters",
                                            options_.name, kMaxParticipantName));
  }
  check_free_descriptors(options_);
  const fdds::DomainParticipantQos qos = participant_qos(options_);
  set_up_library();
  participant_ = fdds::DomainParticipantFactory::get_instance()->create_participant(
      static_cast<fdds::DomainId_t>(options_.domain_id), qos, as_listener(),
      fdds::StatusMask::none());
  if (participant_ == nullptr) {
    refuse_participant(options_,
                       "the library could not create it (too many participants on this host?)");
  }
  if (is_secure()) check_own_identity();
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
        !is_ok(type.register_type(participant_))) {
      refuse_participant(options_, "type " + type.get_type_name() + " could not be registered");
    }
    topic = participant_->create_topic(name, type.get_type_name(), fdds::TOPIC_QOS_DEFAULT);
  }
  if (topic == nullptr) {
    refuse_participant(options_, "topic " + name + " could not be created");
  }
  return *topic;
}

void ParticipantCore::check_own_identity() const {
  const auto key = key_of_identity(identity_of(options_.name));
  const frtps::GuidPrefix_t prefix = participant_->guid().guidPrefix;
  if (key && std::equal(key->begin(), key->end(), std::begin(prefix.value))) return;
  refuse_participant(options_, "--security: the library is built without DDS security");
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

void ParticipantCore::on_found(const FoundParticipant& participant) {
  AnnouncedParticipant announced{.key = key_of(participant.prefix),
                                 .name = participant.name,
                                 .user_data = participant.user_data};
  change_presence([&] {
    if (!participant.is_there) {
      authenticated_.left(announced.key);
      presence_.left(announced.key);
    } else if (!is_secure()) {
      presence_.appeared(announced.key, announced.name, announced.user_data);
    } else {
      admit(authenticated_.announced(std::move(announced)));
    }
  });
}

void ParticipantCore::on_authenticated(const frtps::GuidPrefix_t& participant) {
  change_presence([&] { admit(authenticated_.authenticated(key_of(participant))); });
}

void ParticipantCore::on_refused(const frtps::GuidPrefix_t& participant) {
  if (!options_.on_loss) return;
  const auto name = update([&] { return authenticated_.refused(key_of(participant)); });
  if (!name) return;
  options_.on_loss(fmt::format(
      "participant \"{}\" ({:02x}) refused (logged once): not authenticated by the authority of "
      "{}",
      name_in_log(*name), fmt::join(participant.value, ""), options_.security.string()));
}

void ParticipantCore::admit(const std::optional<AnnouncedParticipant>& participant) {
  if (participant) {
    presence_.appeared(participant->key, participant->name, participant->user_data);
  }
}

void ParticipantCore::change_presence(const std::function<void()>& change) {
  const auto endpoints = update([&] {
    change();
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

void ParticipantCore::on_found(const FoundEndpoint& endpoint) {
  update([&] {
    const PeerKind kind = endpoint.is_writer ? PeerKind::kWriter : PeerKind::kReader;
    auto& endpoints = discovered_[{kind, endpoint.topic}];
    if (endpoint.is_there) {
      endpoints.insert(endpoint.guid);
    } else {
      endpoints.erase(endpoint.guid);
    }
  });
}

}  // namespace hlc::dds
