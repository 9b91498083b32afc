#pragma once

#include <exception>
#include <string>

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

/// The only entry to Fast DDS: its headers, and our own names for everything that changes from
/// version to version (2.9 here; 2.11 to 2.14 deprecate, 3.x moves and renames). The rest of this
/// folder uses these names and the DDS standard's, which stay. Only sources of this folder include
/// this file.
namespace hlc::dds {

namespace fdds = eprosima::fastdds::dds;     ///< the standard's interface
namespace frtps = eprosima::fastrtps::rtps;  ///< GUIDs and locators; 3.x: eprosima::fastdds::rtps

using LibraryDuration = eprosima::fastrtps::Duration_t;
using UdpTransport = eprosima::fastdds::rtps::UDPv4TransportDescriptor;
using SharedMemoryTransport = eprosima::fastdds::rtps::SharedMemTransportDescriptor;
using RemoteServer = eprosima::fastdds::rtps::RemoteServerAttributes;
using SerializedPayload = frtps::SerializedPayload_t;
using LibraryReturnCode = eprosima::fastrtps::types::ReturnCode_t;

[[nodiscard]] inline bool is_ok(const LibraryReturnCode& code) {
  return code == LibraryReturnCode::RETCODE_OK;
}

/// Throws if the library lacks one of the functions that are replaced (README.md): otherwise the
/// process would end at its first heartbeat.
void find_library_functions();
/// The library's own errors go to stderr.
void log_library_errors();
/// A write never runs a reader's callback in the writing thread.
void turn_off_delivery_within_process();
/// Called by one thread: the discovery threads of two participants would create the factories at
/// the same time, and one of each would be lost.
void make_type_factories();
/// Such as "2.9.1".
[[nodiscard]] std::string fast_dds_version();

/// Events of discovery.
class DiscoveryListener : private fdds::DomainParticipantListener {
 protected:
  struct FoundParticipant {
    frtps::GuidPrefix_t prefix;
    std::string name;
    std::string user_data;
    bool is_there{};  ///< false: it has left, or its lease has expired
  };
  struct FoundEndpoint {
    frtps::GUID_t guid;
    std::string topic;
    bool is_writer{};
    bool is_there{};
  };

  /// On the library's threads.
  virtual void on_found(const FoundParticipant& participant) = 0;
  /// With DDS security: the participant has proven its identity.
  virtual void on_authenticated(const frtps::GuidPrefix_t& participant) = 0;
  /// With DDS security: it has no identity. Again with each of its attempts. Of one whose handshake
  /// fails, since it has an identity of another authority, the library reports nothing.
  virtual void on_refused(const frtps::GuidPrefix_t& participant) = 0;
  virtual void on_found(const FoundEndpoint& endpoint) = 0;

  [[nodiscard]] fdds::DomainParticipantListener* as_listener() { return this; }

 private:
  void on_participant_discovery(fdds::DomainParticipant* participant,
                                frtps::ParticipantDiscoveryInfo&& info) final;
  void onParticipantAuthentication(fdds::DomainParticipant* participant,
                                   frtps::ParticipantAuthenticationInfo&& info) final;
  void on_subscriber_discovery(fdds::DomainParticipant* participant,
                               frtps::ReaderDiscoveryInfo&& info) final;
  void on_publisher_discovery(fdds::DomainParticipant* participant,
                              frtps::WriterDiscoveryInfo&& info) final;
};

/// The generated type support, except that bytes it cannot read yield "not a message" instead of an
/// exception on the library's receiving thread.
template <class PubSubType>
class TolerantType : public PubSubType {
 public:
  bool deserialize(SerializedPayload* payload, void* data) override {
    try {
      return PubSubType::deserialize(payload, data);
    } catch (const std::exception&) {
      return false;
    }
  }
};

/// Whether participants that use the type announce its type object (the lab's do).
inline void announce_type_object(const fdds::TypeSupport& type, bool announce) {
  type->auto_fill_type_object(announce);
  type->auto_fill_type_information(announce);
}

}  // namespace hlc::dds
