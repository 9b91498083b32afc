#pragma once

#include <cstddef>
#include <cstdint>
#include <exception>

#include <fastdds/dds/core/status/MatchedStatus.hpp>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/domain/DomainParticipantListener.hpp>
#include <fastdds/dds/domain/qos/DomainParticipantQos.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/DataWriterListener.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/publisher/qos/DataWriterQos.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/subscriber/qos/DataReaderQos.hpp>
#include <fastdds/dds/topic/Topic.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.hpp>
#include <fastdds/rtps/transport/shared_mem/SharedMemTransportDescriptor.hpp>
#include <fastdds/utils/IPLocator.hpp>

/// Names of Fast DDS 3 for fast_dds.hpp, which alone includes this file.
namespace hlc::dds {

namespace fdds = eprosima::fastdds::dds;    ///< the standard's interface
namespace frtps = eprosima::fastdds::rtps;  ///< GUIDs and locators

inline constexpr int kLibraryMajor = 3;

using LibraryDuration = fdds::Duration_t;
using UdpTransport = frtps::UDPv4TransportDescriptor;
using SharedMemoryTransport = frtps::SharedMemTransportDescriptor;
using SerializedPayload = frtps::SerializedPayload_t;
using LibraryReturnCode = fdds::ReturnCode_t;

[[nodiscard]] inline bool is_ok(LibraryReturnCode code) { return code == fdds::RETCODE_OK; }
bool is_ok(bool is_done) = delete;  // true would be a code of failure

inline constexpr auto kHeartbeatPeriod = &frtps::WriterTimes::heartbeat_period;
inline constexpr auto kInitialHeartbeatDelay = &frtps::WriterTimes::initial_heartbeat_delay;
inline constexpr auto kNackResponseDelay = &frtps::WriterTimes::nack_response_delay;
inline constexpr auto kNackSuppression = &frtps::WriterTimes::nack_supression_duration;
inline constexpr auto kInitialAcknackDelay = &frtps::ReaderTimes::initial_acknack_delay;
inline constexpr auto kHeartbeatResponseDelay = &frtps::ReaderTimes::heartbeat_response_delay;

/// What a client of discovery needs to know of its server: no longer its prefix.
inline void add_discovery_server(frtps::DiscoverySettings& settings,
                                 const frtps::GuidPrefix_t& /*prefix*/,
                                 const frtps::Locator_t& address) {
  settings.m_DiscoveryServers.push_back(address);
}

[[nodiscard]] inline bool has_key(const fdds::TypeSupport& type) {
  return type->is_compute_key_provided;
}

[[nodiscard]] inline bool announces_type_object(const fdds::TypeSupport& type) {
  type->register_type_object_representation();
  return type->type_identifiers().type_identifier1()._d() != fdds::xtypes::TK_NONE;
}

[[nodiscard]] inline bool announces_no_type_object(const fdds::TypeSupport& type) {
  return !announces_type_object(type);
}

// The first representation is that of 2.x and of the lab.
[[nodiscard]] inline std::uint32_t serialized_size(fdds::TopicDataType& type, const void* sample) {
  return type.calculate_serialized_size(sample, fdds::XCDR_DATA_REPRESENTATION);
}

[[nodiscard]] inline bool serialize(fdds::TopicDataType& type, const void* sample,
                                    SerializedPayload& payload) {
  return type.serialize(sample, payload, fdds::XCDR_DATA_REPRESENTATION);
}

[[nodiscard]] inline bool deserialize(fdds::TopicDataType& type, SerializedPayload& payload,
                                      void* sample) {
  return type.deserialize(payload, sample);
}

/// Without the encapsulation.
template <class PubSubType>
[[nodiscard]] std::size_t message_bytes(const typename PubSubType::type* sample) {
  static PubSubType type;
  return serialized_size(type, sample) - SerializedPayload::representation_header_size;
}

/// The generated type support, except that bytes it cannot read yield "not a message" instead of an
/// exception on the library's receiving thread.
template <class PubSubType>
class TolerantType : public PubSubType {
 public:
  /// @param announces  participants that use the type announce its type object (the lab's do)
  explicit TolerantType(bool announces) : announces_{announces} {}

  bool deserialize(SerializedPayload& payload, void* data) override {
    // Fast CDR 2.3 takes the padding that the last bits of the header declare off the end unseen: a
    // header with less behind it would be read beyond its end.
    constexpr std::uint32_t kHeader = SerializedPayload::representation_header_size;
    if (payload.length < kHeader || payload.length - kHeader < (payload.data[kHeader - 1] & 3U))
      return false;
    try {
      return PubSubType::deserialize(payload, data) && is_whole(payload, data);
    } catch (const std::exception&) {
      return false;
    }
  }

  void register_type_object_representation() override {
    if (announces_) PubSubType::register_type_object_representation();
  }

 private:
  // Fast CDR 2 takes bytes that end between two members for a message without the further ones.
  // The size that it computes beforehand may be larger than that of the message.
  bool is_whole(const SerializedPayload& payload, const void* data) {
    SerializedPayload again(serialized_size(*this, data));
    return hlc::dds::serialize(*this, data, again) && again.length <= payload.length;
  }

  bool announces_;
};

}  // namespace hlc::dds
