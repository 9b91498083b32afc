#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "hlc_bridge/dds/endpoint_peers.hpp"
#include "hlc_bridge/dds/endpoint_qos.hpp"

namespace hlc::dds {

/// A Fast DDS reader of any type. Only sources of this folder include this file.
class ReaderEndpoint : private fdds::DataReaderListener {
 public:
  /// What is wrong with a sample: its number of invalid entries, that it may not be of its
  /// publisher, and that it was not admitted (ParticipantOptions::admits).
  struct Fault {
    std::uint64_t invalid{};
    bool is_of_another{};
    bool is_in_excess{};
  };

  /// `on_sample(sample, writer)`: `sample` is of the type's generated class.
  ReaderEndpoint(std::shared_ptr<ParticipantCore> core, const std::string& topic,
                 const fdds::TypeSupport& type, const EndpointQos& qos,
                 std::function<Fault(const void* sample, const frtps::GUID_t& writer)> on_sample,
                 std::function<void()> on_matched_change);
  ~ReaderEndpoint() override;
  ReaderEndpoint(const ReaderEndpoint&) = delete;
  ReaderEndpoint& operator=(const ReaderEndpoint&) = delete;

  [[nodiscard]] const EndpointPeers& peers() const { return *peers_; }
  [[nodiscard]] std::uint64_t dropped() const { return dropped_; }
  [[nodiscard]] std::uint64_t of_others() const { return of_others_; }
  [[nodiscard]] std::uint64_t lost() const { return lost_; }

 private:
  void on_data_available(fdds::DataReader* reader) override;
  void on_subscription_matched(fdds::DataReader* reader,
                               const fdds::SubscriptionMatchedStatus& status) override;
  void on_sample_lost(fdds::DataReader* reader, const fdds::SampleLostStatus& status) override;
  void on_sample_rejected(fdds::DataReader* reader,
                          const fdds::SampleRejectedStatus& status) override;
  void count(const fdds::DataReader& reader, const Fault& fault);
  void count_lost(const fdds::DataReader& reader, std::uint64_t count);
  void log(const fdds::DataReader& reader, const std::string& what) const;

  std::shared_ptr<ParticipantCore> core_;
  fdds::TypeSupport type_;
  std::function<Fault(const void*, const frtps::GUID_t&)> on_sample_;
  Gate gate_;
  std::atomic<std::uint64_t> dropped_{};
  std::atomic<std::uint64_t> of_others_{};
  std::atomic<std::uint64_t> lost_{};
  std::shared_ptr<EndpointPeers> peers_;
  fdds::DataReader* reader_{};
};

}  // namespace hlc::dds
