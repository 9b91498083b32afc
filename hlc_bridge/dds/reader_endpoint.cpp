#include "hlc_bridge/dds/reader_endpoint.hpp"

#include <stdexcept>
#include <utility>

#include "hlc_bridge/dds/library_qos.hpp"

namespace hlc::dds {

ReaderEndpoint::ReaderEndpoint(std::shared_ptr<ParticipantCore> core, const std::string& topic,
                               const fdds::TypeSupport& type, const EndpointQos& qos,
                               std::function<Fault(const void*, const frtps::GUID_t&)> on_sample,
                               std::function<void()> on_matched_change)
    : core_{std::move(core)},
      type_{type},
      on_sample_{std::move(on_sample)},
      peers_{EndpointPeers::create(core_, PeerKind::kWriter, topic, std::move(on_matched_change))} {
  fdds::StatusMask events = fdds::StatusMask::data_available();
  events << fdds::StatusMask::subscription_matched() << fdds::StatusMask::sample_lost()
         << fdds::StatusMask::sample_rejected();
  reader_ = core_->subscriber().create_datareader(&core_->topic(topic, type), reader_qos(qos), this,
                                                  events);
  if (reader_ == nullptr) {
    throw std::runtime_error("reader on topic " + topic + " could not be created");
  }
}

ReaderEndpoint::~ReaderEndpoint() {
  gate_.close();
  peers_->close();
  reader_->set_listener(nullptr);
  core_->subscriber().delete_datareader(reader_);
}

void ReaderEndpoint::on_data_available(fdds::DataReader* reader) {
  gate_.enter([&] {
    const std::shared_ptr<void> sample{type_.create_data(),
                                       [this](void* data) { type_.delete_data(data); }};
    fdds::SampleInfo info;
    while (is_ok(reader->take_next_sample(sample.get(), &info))) {
      const frtps::GUID_t writer = frtps::iHandle2GUID(info.publication_handle);
      if (!info.valid_data || core_->is_own(writer)) continue;
      count(*reader, on_sample_(sample.get(), writer));
    }
  });
}

void ReaderEndpoint::count(const fdds::DataReader& reader, const Fault& fault) {
  if (fault.is_of_another) ++of_others_;
  if (fault.is_in_excess) ++lost_;
  if (fault.invalid > 0 && dropped_.fetch_add(fault.invalid) == 0) {
    log(reader, "invalid content received and dropped (logged once)");
  }
}

void ReaderEndpoint::on_subscription_matched(fdds::DataReader*,
                                             const fdds::SubscriptionMatchedStatus& status) {
  peers_->on_matched(status, status.last_publication_handle);
}

void ReaderEndpoint::on_sample_lost(fdds::DataReader* reader,
                                    const fdds::SampleLostStatus& status) {
  count_lost(*reader, static_cast<std::uint64_t>(status.total_count_change));
}

void ReaderEndpoint::on_sample_rejected(fdds::DataReader* reader,
                                        const fdds::SampleRejectedStatus& status) {
  count_lost(*reader, static_cast<std::uint64_t>(status.total_count_change));
}

void ReaderEndpoint::count_lost(const fdds::DataReader& reader, std::uint64_t count) {
  if (count > 0 && lost_.fetch_add(count) == 0) {
    log(reader, "message lost (logged once)");
  }
}

void ReaderEndpoint::log(const fdds::DataReader& reader, const std::string& what) const {
  const auto& on_loss = core_->options().on_loss;
  if (on_loss) on_loss("topic " + reader.get_topicdescription()->get_name() + ": " + what);
}

}  // namespace hlc::dds
