#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "hlc_bridge/dds/authenticated_participants.hpp"
#include "hlc_bridge/dds/fast_dds.hpp"
#include "hlc_bridge/dds/gate.hpp"
#include "hlc_bridge/dds/participant.hpp"
#include "hlc_bridge/dds/presence.hpp"

/// Only sources of this folder include this file.
namespace hlc::dds {

class EndpointPeers;

[[nodiscard]] ParticipantKey key_of(const frtps::GuidPrefix_t& prefix);

/// The other end of a match.
enum class PeerKind : std::uint8_t { kReader, kWriter };

/// The Fast DDS participant with its presence, and what its endpoints share. Lives as long as the
/// last of them.
///
/// Locks: `mutex_` guards the tables and is never held while something else is called; the gates
/// are held while the user's callback runs. Order: DDS locks, gates, the user's locks, `mutex_`.
class ParticipantCore : private DiscoveryListener {
 public:
  ParticipantCore(const ParticipantOptions& options, std::function<void()> on_presence_change);
  ~ParticipantCore() override;
  ParticipantCore(const ParticipantCore&) = delete;
  ParticipantCore& operator=(const ParticipantCore&) = delete;

  [[nodiscard]] const ParticipantOptions& options() const { return options_; }
  [[nodiscard]] fdds::Publisher& publisher() { return *publisher_; }
  [[nodiscard]] fdds::Subscriber& subscriber() { return *subscriber_; }
  /// The topic, created and its type registered on first use. Throws std::runtime_error.
  [[nodiscard]] fdds::Topic& topic(const std::string& name, const fdds::TypeSupport& type);
  /// True for this participant's own endpoints.
  [[nodiscard]] bool is_own(const frtps::GUID_t& endpoint) const;
  /// No presence callback after this.
  void close() { presence_gate_.close(); }

  /// `access(presence)` under the lock.
  template <class Access>
  auto with_presence(Access&& access) const {
    const std::lock_guard lock{mutex_};
    return access(presence_);
  }

  /// `change()` under the lock, then every wait_until checks its condition again.
  template <class Change>
  auto update(Change&& change) {
    const std::lock_guard lock{mutex_};
    changed_.notify_all();
    return change();
  }

  /// Waits until `condition(presence)` holds; false if the deadline passes first.
  template <class Condition>
  bool wait_until(std::chrono::steady_clock::time_point deadline, Condition&& condition) const {
    std::unique_lock lock{mutex_};
    return changed_.wait_until(lock, deadline, [&] { return condition(presence_); });
  }

  /// Other participants' endpoints of that kind on a topic, as far as discovered (matching or not).
  /// @pre the lock is held: within `update`
  [[nodiscard]] std::set<frtps::GUID_t> discovered(PeerKind kind, const std::string& topic) const;

  /// Notifies the peers also when presence changes, since their names can become known then.
  void add_peers(const std::shared_ptr<EndpointPeers>& peers);

 private:
  void on_found(const FoundParticipant& participant) override;
  void on_authenticated(const frtps::GuidPrefix_t& participant) override;
  void on_refused(const frtps::GuidPrefix_t& participant) override;
  void on_found(const FoundEndpoint& endpoint) override;

  [[nodiscard]] bool is_secure() const { return !options_.security.empty(); }
  /// A library without security ignores that it is asked for. Throws std::runtime_error.
  void check_own_identity() const;
  /// `change()` under the lock; then notifies all that depend on the presence.
  void change_presence(const std::function<void()>& change);
  void admit(const std::optional<AnnouncedParticipant>& participant);

  ParticipantOptions options_;
  std::function<void()> on_presence_change_;
  Gate presence_gate_;

  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
  Presence presence_;
  AuthenticatedParticipants authenticated_;
  std::map<std::pair<PeerKind, std::string>, std::set<frtps::GUID_t>> discovered_;
  std::vector<std::weak_ptr<EndpointPeers>> endpoints_;

  std::mutex topics_mutex_;
  std::map<std::string, fdds::Topic*> topics_;
  fdds::DomainParticipant* participant_{};
  fdds::Publisher* publisher_{};
  fdds::Subscriber* subscriber_{};
};

}  // namespace hlc::dds
