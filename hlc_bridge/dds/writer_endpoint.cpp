#include "hlc_bridge/dds/writer_endpoint.hpp"

#include <cstddef>
#include <stdexcept>
#include <utility>

#include "hlc_bridge/dds/library_qos.hpp"

namespace hlc::dds {

WriterEndpoint::WriterEndpoint(std::shared_ptr<ParticipantCore> core, const std::string& topic,
                               const fdds::TypeSupport& type, const EndpointQos& qos,
                               std::function<void()> on_matched_change)
    : core_{std::move(core)},
      topic_{topic},
      type_{type},
      peers_{EndpointPeers::create(core_, PeerKind::kReader, topic, std::move(on_matched_change))} {
  writer_ = core_->publisher().create_datawriter(&core_->topic(topic, type), writer_qos(qos), this,
                                                 fdds::StatusMask::publication_matched());
  if (writer_ == nullptr) {
    throw std::runtime_error("writer on topic " + topic + " could not be created");
  }
}

WriterEndpoint::~WriterEndpoint() {
  peers_->close();
  writer_->set_listener(nullptr);
  // Fast DDS 2.9 releases the history piece by piece while a heartbeat on another thread may still
  // iterate over it, in the worst case without end. Samples not acknowledged by now are lost either
  // way.
  std::size_t removed = 0;
  writer_->clear_history(&removed);
  core_->publisher().delete_datawriter(writer_);
}

bool WriterEndpoint::is_observed() const {
  return static_cast<bool>(core_->options().on_published);
}

void WriterEndpoint::observe(void* sample, const MessageStamp& stamp) const {
  SerializedPayload payload(serialized_size(*type_, sample));
  if (!serialize(*type_, sample, payload)) return;  // then it was not accepted either
  core_->options().on_published(
      {.role = core_->options().role,
       .topic = topic_,
       .type = type_.get_type_name(),
       .cdr = {reinterpret_cast<const char*>(payload.data), payload.length},
       .stamp = stamp});
}

void WriterEndpoint::on_publication_matched(fdds::DataWriter*,
                                            const fdds::PublicationMatchedStatus& status) {
  peers_->on_matched(status, status.last_subscription_handle);
}

}  // namespace hlc::dds
