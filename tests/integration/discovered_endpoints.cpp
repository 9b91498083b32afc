#include "tests/integration/discovered_endpoints.hpp"

#include <array>
#include <map>
#include <mutex>
#include <stdexcept>

#include "hlc_bridge/dds/fast_dds.hpp"
#include "hlc_bridge/dds/library.hpp"
#include "hlc_bridge/dds/participant_qos.hpp"

namespace hlc::test {

namespace fdds = dds::fdds;
namespace frtps = dds::frtps;

class DiscoveredEndpoints::Listener : public fdds::DomainParticipantListener {
 public:
  explicit Listener(const dds::ParticipantOptions& options) {
    dds::set_up_library();  // the lab's types: without them their announcements crash the process
    participant_ = fdds::DomainParticipantFactory::get_instance()->create_participant(
        static_cast<fdds::DomainId_t>(options.domain_id), dds::participant_qos(options), this,
        fdds::StatusMask::none());
    if (participant_ == nullptr) throw std::runtime_error("the domain cannot be joined");
  }
  ~Listener() override {
    participant_->set_listener(nullptr);
    fdds::DomainParticipantFactory::get_instance()->delete_participant(participant_);
  }

  [[nodiscard]] std::vector<Endpoint> so_far() const {
    const std::lock_guard lock{mutex_};
    std::vector<Endpoint> endpoints;
    for (const auto& [guid, endpoint] : endpoints_) {
      endpoints.push_back(endpoint);
      const auto name = names_.find(guid.guidPrefix);
      if (name != names_.end()) endpoints.back().process = name->second;
    }
    return endpoints;
  }

  void on_participant_discovery(fdds::DomainParticipant* /*own*/,
                                frtps::ParticipantDiscoveryInfo&& info) override {
    const std::lock_guard lock{mutex_};
    names_.try_emplace(info.info.m_guid.guidPrefix, info.info.m_participantName.to_string());
  }
  void on_publisher_discovery(fdds::DomainParticipant* /*own*/,
                              frtps::WriterDiscoveryInfo&& info) override {
    if (info.status == frtps::WriterDiscoveryInfo::DISCOVERED_WRITER) add(info.info, true);
  }
  void on_subscriber_discovery(fdds::DomainParticipant* /*own*/,
                               frtps::ReaderDiscoveryInfo&& info) override {
    if (info.status == frtps::ReaderDiscoveryInfo::DISCOVERED_READER) add(info.info, false);
  }

 private:
  template <class ProxyData>
  void add(const ProxyData& data, bool is_writer) {
    const std::lock_guard lock{mutex_};
    endpoints_[data.guid()] = {
        .process = {},
        .topic = data.topicName().to_string(),
        .type = data.typeName().to_string(),
        .is_writer = is_writer,
        .is_reliable = data.m_qos.m_reliability.kind == fdds::RELIABLE_RELIABILITY_QOS,
        .is_transient_local = data.m_qos.m_durability.kind != fdds::VOLATILE_DURABILITY_QOS,
        .entity_kind = data.guid().entityId.value[3],
        .has_type_object = data.has_type() || data.has_type_information()};
  }

  mutable std::mutex mutex_;
  std::map<frtps::GuidPrefix_t, std::string> names_;
  std::map<frtps::GUID_t, Endpoint> endpoints_;
  fdds::DomainParticipant* participant_{};
};

DiscoveredEndpoints::DiscoveredEndpoints(const dds::ParticipantOptions& options)
    : listener_(std::make_unique<Listener>(options)) {}

DiscoveredEndpoints::~DiscoveredEndpoints() = default;

std::vector<Endpoint> DiscoveredEndpoints::so_far() const { return listener_->so_far(); }

}  // namespace hlc::test
