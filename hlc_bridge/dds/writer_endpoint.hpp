#pragma once

#include <functional>
#include <memory>
#include <string>

#include "hlc_bridge/dds/endpoint_peers.hpp"
#include "hlc_bridge/dds/endpoint_qos.hpp"
#include "hlc_bridge/dds/message_stamp.hpp"

namespace hlc::dds {

/// A Fast DDS writer of any type. Only sources of this folder include this file.
class WriterEndpoint : private fdds::DataWriterListener {
 public:
  WriterEndpoint(std::shared_ptr<ParticipantCore> core, const std::string& topic,
                 const fdds::TypeSupport& type, const EndpointQos& qos,
                 std::function<void()> on_matched_change);
  ~WriterEndpoint() override;
  WriterEndpoint(const WriterEndpoint&) = delete;
  WriterEndpoint& operator=(const WriterEndpoint&) = delete;

  /// `sample` is of the type's generated class.
  bool write(void* sample) { return is_ok(writer_->write(sample)); }
  /// For ParticipantOptions::on_published.
  [[nodiscard]] bool is_observed() const;
  void observe(void* sample, const MessageStamp& stamp) const;
  [[nodiscard]] const EndpointPeers& peers() const { return *peers_; }

 private:
  void on_publication_matched(fdds::DataWriter* writer,
                              const fdds::PublicationMatchedStatus& status) override;

  std::shared_ptr<ParticipantCore> core_;
  std::string topic_;
  fdds::TypeSupport type_;
  std::shared_ptr<EndpointPeers> peers_;
  fdds::DataWriter* writer_{};
};

}  // namespace hlc::dds
