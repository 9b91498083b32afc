#pragma once

#include <string>

#if HLC_FAST_DDS == 3
#include "hlc_bridge/dds/fast_dds_3.hpp"
#elif HLC_FAST_DDS == 2
#include "hlc_bridge/dds/fast_dds_2.hpp"
#else
#error "HLC_FAST_DDS must be 2 or 3: link with hlc_fast_dds"
#endif

/// The only entry to Fast DDS: its headers, and our own names for everything that changes from
/// version to version: fast_dds_2 for 2.9, fast_dds_3 for 3.2. The rest of this folder uses these
/// names and the DDS standard's, which stay. Only sources of this folder include this file.
namespace hlc::dds {

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
/// Whether the process knows the type object of that type.
[[nodiscard]] bool knows_type_object(const std::string& type_name);
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
#if HLC_FAST_DDS == 3
  void on_participant_discovery(fdds::DomainParticipant* participant,
                                frtps::ParticipantDiscoveryStatus status,
                                const fdds::ParticipantBuiltinTopicData& info,
                                bool& is_ignored) final;
#if HAVE_SECURITY
  void onParticipantAuthentication(fdds::DomainParticipant* participant,
                                   frtps::ParticipantAuthenticationInfo&& info) final;
#endif
  void on_data_reader_discovery(fdds::DomainParticipant* participant,
                                frtps::ReaderDiscoveryStatus status,
                                const fdds::SubscriptionBuiltinTopicData& info,
                                bool& is_ignored) final;
  void on_data_writer_discovery(fdds::DomainParticipant* participant,
                                frtps::WriterDiscoveryStatus status,
                                const fdds::PublicationBuiltinTopicData& info,
                                bool& is_ignored) final;
#else
  void on_participant_discovery(fdds::DomainParticipant* participant,
                                frtps::ParticipantDiscoveryInfo&& info) final;
  void onParticipantAuthentication(fdds::DomainParticipant* participant,
                                   frtps::ParticipantAuthenticationInfo&& info) final;
  void on_subscriber_discovery(fdds::DomainParticipant* participant,
                               frtps::ReaderDiscoveryInfo&& info) final;
  void on_publisher_discovery(fdds::DomainParticipant* participant,
                              frtps::WriterDiscoveryInfo&& info) final;
#endif
};

}  // namespace hlc::dds
