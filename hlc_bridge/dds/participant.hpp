#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "hlc_bridge/dds/presence.hpp"
#include "hlc_bridge/dds/transport.hpp"
#include "hlc_bridge/messages/time_grid.hpp"
#include "planner/coordination/messages.hpp"

namespace hlc::dds {

class ParticipantCore;  // Fast DDS lives behind this

/// The instant or the step of the run at which a message was published, as far as the message
/// itself shows it.
struct MessageStamp {
  std::optional<Nanoseconds> time;
  std::optional<StepIndex> step;
};

/// A message as a writer published it.
struct PublishedMessage {
  DomainRole role{};         ///< of the domain
  const std::string& topic;  ///< its name on the domain
  const std::string& type;   ///< in IDL: "VehicleState", "hlc::TrafficMessage"
  std::string_view cdr;      ///< with the encapsulation header
  MessageStamp stamp;
};

struct ParticipantOptions {
  std::string name;  ///< the process's node id: others see its presence under this name
  int domain_id{};
  DomainRole role{DomainRole::kLab};
  Transport transport{Transport::kLoopback};
  /// That long after its death others see it as lost.
  Nanoseconds lease{2 * kNanosecondsPerSecond};
  std::optional<DiscoveryServer> discovery_server;  ///< none: simple discovery (multicast)
  bool is_discovery_server{};  ///< it is that server itself, not a client of it
  /// IPv4 addresses of machines to ask, too, where multicast does not pass. Simple discovery only.
  std::vector<std::string> peers{};
  /// Version of the program, published to all others on the domain.
  std::string version{};
  /// Folder of the identities and rights (security.hpp); empty: without DDS security. With it only
  /// participants of the same authority are present, each under the name of its identity only.
  std::filesystem::path security{};
  /// Called on a DDS thread with a line for the log: once per reader and kind if a message
  /// contained an invalid entry, or was lost (Reader::dropped, Reader::lost); once per participant
  /// that is refused by DDS security. It must only queue if log lines are themselves published on a
  /// topic.
  std::function<void(const std::string& line)> on_loss{};
  /// Called on a DDS thread before a received message is passed on: false if those of its publisher
  /// that wait to be read leave no room for so many bytes; the message is then dropped. It must not
  /// wait. Empty: all are passed on.
  std::function<bool(const ParticipantKey& publisher, std::size_t bytes)> admits{};
  /// Called for every message after it was accepted for publishing, on the publishing thread. It
  /// must not wait.
  std::function<void(const PublishedMessage& message)> on_published{};
};

/// One process on one domain: the entry to DDS, and the presence of others.
///
/// The first participant of a process registers the lab's types. A process has at most one
/// participant per domain. A participant's own readers do not receive what its writers publish.
///
/// Writers and readers keep the parts of the participant that they need alive: the order of
/// destruction does not matter.
class Participant {
 public:
  /// `on_presence_change` is called on a DDS thread after a change of alive() or lost(), possibly
  /// before the constructor has returned, and never after the destructor. It must only notify.
  /// Throws std::invalid_argument for a bad option, std::runtime_error if the library refuses.
  explicit Participant(const ParticipantOptions& options,
                       std::function<void()> on_presence_change = {});
  ~Participant();
  Participant(const Participant&) = delete;
  Participant& operator=(const Participant&) = delete;

  /// Names of the other participants now on the domain.
  [[nodiscard]] std::set<std::string> alive() const;
  [[nodiscard]] bool is_alive(const std::string& name) const;
  /// Names that have left, or whose lease has expired. A name that returns is alive and no longer
  /// lost.
  [[nodiscard]] std::set<std::string> lost() const;
  [[nodiscard]] bool is_lost(const std::string& name) const;

  /// Version of each participant that publishes one, by name.
  [[nodiscard]] std::map<std::string, std::string> versions() const;

  /// Waits until all these names are alive; false if `deadline` passes first.
  [[nodiscard]] bool wait_for(const std::set<std::string>& names,
                              std::chrono::steady_clock::time_point deadline) const;

  [[nodiscard]] const ParticipantOptions& options() const;

  /// For Writer and Reader.
  [[nodiscard]] const std::shared_ptr<ParticipantCore>& core() const { return core_; }

 private:
  std::shared_ptr<ParticipantCore> core_;
};

}  // namespace hlc::dds
