#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <exception>

#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastdds/rtps/transport/shared_mem/SharedMemTransportDescriptor.h>
#include <fastrtps/utils/IPLocator.h>
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

/// Names of Fast DDS 2 for fast_dds.hpp, which alone includes this file.
namespace hlc::dds {

namespace fdds = eprosima::fastdds::dds;     ///< the standard's interface
namespace frtps = eprosima::fastrtps::rtps;  ///< GUIDs and locators

inline constexpr int kLibraryMajor = 2;

using LibraryDuration = eprosima::fastrtps::Duration_t;
using UdpTransport = eprosima::fastdds::rtps::UDPv4TransportDescriptor;
using SharedMemoryTransport = eprosima::fastdds::rtps::SharedMemTransportDescriptor;
using SerializedPayload = frtps::SerializedPayload_t;
using LibraryReturnCode = eprosima::fastrtps::types::ReturnCode_t;

[[nodiscard]] inline bool is_ok(const LibraryReturnCode& code) {
  return code == LibraryReturnCode::RETCODE_OK;
}
/// What writers return in 2.x: a code in 3.x, where success is 0. For nothing that converts to
/// bool.
[[nodiscard]] inline bool is_ok(std::same_as<bool> auto is_done) { return is_done; }

inline constexpr auto kHeartbeatPeriod = &frtps::WriterTimes::heartbeatPeriod;
inline constexpr auto kInitialHeartbeatDelay = &frtps::WriterTimes::initialHeartbeatDelay;
inline constexpr auto kNackResponseDelay = &frtps::WriterTimes::nackResponseDelay;
inline constexpr auto kNackSuppression = &frtps::WriterTimes::nackSupressionDuration;
inline constexpr auto kInitialAcknackDelay = &frtps::ReaderTimes::initialAcknackDelay;
inline constexpr auto kHeartbeatResponseDelay = &frtps::ReaderTimes::heartbeatResponseDelay;

/// What a client of discovery needs to know of its server.
inline void add_discovery_server(frtps::DiscoverySettings& settings,
                                 const frtps::GuidPrefix_t& prefix,
                                 const frtps::Locator_t& address) {
  eprosima::fastdds::rtps::RemoteServerAttributes server;
  server.guidPrefix = prefix;
  server.metatrafficUnicastLocatorList.push_back(address);
  settings.m_DiscoveryServers.push_back(server);
}

[[nodiscard]] inline bool has_key(const fdds::TypeSupport& type) { return type->m_isGetKeyDefined; }

/// Both the object and what it is called by.
[[nodiscard]] inline bool announces_type_object(const fdds::TypeSupport& type) {
  return type->auto_fill_type_object() && type->auto_fill_type_information();
}
/// Neither of them.
[[nodiscard]] inline bool announces_no_type_object(const fdds::TypeSupport& type) {
  return !type->auto_fill_type_object() && !type->auto_fill_type_information();
}

[[nodiscard]] inline std::uint32_t serialized_size(fdds::TopicDataType& type, void* sample) {
  return type.getSerializedSizeProvider(sample)();
}

[[nodiscard]] inline bool serialize(fdds::TopicDataType& type, void* sample,
                                    SerializedPayload& payload) {
  return type.serialize(sample, &payload);
}

[[nodiscard]] inline bool deserialize(fdds::TopicDataType& type, SerializedPayload& payload,
                                      void* sample) {
  return type.deserialize(&payload, sample);
}

/// Without the encapsulation.
template <class PubSubType>
[[nodiscard]] std::size_t message_bytes(const typename PubSubType::type* sample) {
  return PubSubType::type::getCdrSerializedSize(*sample);
}

/// The generated type support, except that bytes it cannot read yield "not a message" instead of an
/// exception on the library's receiving thread.
template <class PubSubType>
class TolerantType : public PubSubType {
 public:
  /// @param announces  participants that use the type announce its type object (the lab's do)
  explicit TolerantType(bool announces) {
    this->auto_fill_type_object(announces);
    this->auto_fill_type_information(announces);
  }

  bool deserialize(SerializedPayload* payload, void* data) override {
    try {
      return PubSubType::deserialize(payload, data);
    } catch (const std::exception&) {
      return false;
    }
  }
};

}  // namespace hlc::dds
