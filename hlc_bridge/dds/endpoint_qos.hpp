#pragma once

#include <chrono>
#include <cstdint>

#include "hlc_bridge/dds/topics.hpp"
#include "hlc_bridge/dds/transport.hpp"

namespace hlc::dds {

enum class Reliability : std::uint8_t { kBestEffort, kReliable };
enum class Durability : std::uint8_t { kVolatile, kTransientLocal };

/// The complete quality of service of one writer or reader. Nothing is left to the library's
/// defaults, which differ between writers and readers and hold 10 instances only. Data sharing is
/// always off: a process that dies while it holds the lock of a shared history makes the writes of
/// all others throw after 1 s. Peers that have it on use the transport towards us.
struct EndpointQos {
  Reliability reliability{};
  Durability durability{};
  int history_depth{};  ///< samples kept, per instance if keyed; 0: keep all, up to the limits
  int max_instances{};  ///< 1 without key
  int max_samples_per_instance{};
  int max_samples{};  ///< max_instances * max_samples_per_instance
  /// The library may allocate a whole history of the types' nominal sizes at once: good for the
  /// lab's small types, not for lists of polygons.
  bool preallocated{};
  std::chrono::milliseconds max_blocking{};        ///< a write fails after this
  std::chrono::milliseconds heartbeat_period{};    ///< writer: until all is acknowledged
  std::chrono::milliseconds heartbeat_delay{};     ///< writer: before the first one
  std::chrono::milliseconds nack_response{};       ///< writer: from a loss reported to its repair
  std::chrono::milliseconds nack_suppression{};    ///< writer: repeated reports ignored for
  std::chrono::milliseconds initial_acknack{};     ///< reader: from the match to the first report
  std::chrono::milliseconds heartbeat_response{};  ///< reader: from a heartbeat to its report
};

struct TopicQos {
  EndpointQos writer;
  EndpointQos reader;
};

/// The row of the table for this topic. Throws std::invalid_argument if the topic does not belong
/// on a domain of that role.
[[nodiscard]] TopicQos topic_qos(TopicId id, DomainRole role, Transport transport);

/// Instances of a keyed topic: one for each value that its key, an octet, can have, not for each
/// vehicle (kMaxLabVehicleId). The library gives an instance to every key that arrives, before
/// anybody sees that it is no vehicle's, keeps it while its writer is there, and rejects samples of
/// new keys once none is left: 40 messages with invalid ids would silence every vehicle.
inline constexpr int kMaxInstances = 256;

}  // namespace hlc::dds
