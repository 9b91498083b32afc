#pragma once

#include <memory>
#include <string>
#include <vector>

#include "hlc_bridge/dds/participant.hpp"

namespace hlc::test {

/// A writer or a reader as its participant announces it on the wire.
struct Endpoint {
  std::string process;  ///< name of its participant
  std::string topic;
  std::string type;
  bool is_writer{};
  bool is_reliable{};
  bool is_transient_local{};  ///< else volatile
  int entity_kind{};          ///< last byte of its entity id; without key 3 (writer) or 4 (reader)
  bool has_type_object{};     ///< a type object, or the type information that asks for one
};

/// Listens to the discovery traffic of one domain, as a participant without endpoints.
class DiscoveredEndpoints {
 public:
  /// @throws std::runtime_error if the domain cannot be joined
  explicit DiscoveredEndpoints(const dds::ParticipantOptions& options);
  ~DiscoveredEndpoints();

  /// All that were announced so far, whether or not they are still there.
  [[nodiscard]] std::vector<Endpoint> so_far() const;

 private:
  class Listener;
  std::unique_ptr<Listener> listener_;
};

}  // namespace hlc::test
