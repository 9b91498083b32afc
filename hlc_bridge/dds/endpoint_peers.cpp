#include "hlc_bridge/dds/endpoint_peers.hpp"

#include <algorithm>
#include <utility>

namespace hlc::dds {

EndpointPeers::EndpointPeers(ParticipantCore& core, PeerKind kind, std::string topic,
                             std::function<void()> on_change)
    : core_{core}, kind_{kind}, topic_{std::move(topic)}, on_change_{std::move(on_change)} {}

std::shared_ptr<EndpointPeers> EndpointPeers::create(const std::shared_ptr<ParticipantCore>& core,
                                                     PeerKind kind, const std::string& topic,
                                                     std::function<void()> on_change) {
  std::shared_ptr<EndpointPeers> peers{new EndpointPeers(*core, kind, topic, std::move(on_change))};
  core->add_peers(peers);
  return peers;
}

void EndpointPeers::on_matched(const fdds::MatchedStatus& status,
                               const frtps::InstanceHandle_t& last_peer) {
  const frtps::GUID_t peer = frtps::iHandle2GUID(last_peer);
  core_.update([&] {
    if (status.current_count_change == 1) {
      if (!core_.is_own(peer)) {
        peers_.insert(peer);
      }
    } else if (status.current_count_change == -1) {
      peers_.erase(peer);
    } else {
      // Of two matches at the same moment on two threads of the library, the status names only the
      // later one. The endpoints discovered on this topic are those that have matched.
      peers_ = core_.discovered(kind_, topic_);
    }
  });
  notify();
}

void EndpointPeers::notify() {
  gate_.enter([&] {
    if (on_change_) {
      on_change_();
    }
  });
}

std::set<std::string> EndpointPeers::names_in(const Presence& presence) const {
  std::set<std::string> names;
  for (const frtps::GUID_t& peer : peers_) {
    for (std::string& name : presence.names_of(key_of(peer.guidPrefix)))
      names.insert(std::move(name));
  }
  return names;
}

std::size_t EndpointPeers::count() const {
  return core_.with_presence([&](const Presence&) { return peers_.size(); });
}

std::set<std::string> EndpointPeers::names() const {
  return core_.with_presence([&](const Presence& presence) { return names_in(presence); });
}

bool EndpointPeers::wait_for(std::size_t count,
                             std::chrono::steady_clock::time_point deadline) const {
  return core_.wait_until(deadline, [&](const Presence&) { return peers_.size() >= count; });
}

bool EndpointPeers::wait_for(const std::set<std::string>& names,
                             std::chrono::steady_clock::time_point deadline) const {
  return core_.wait_until(deadline, [&](const Presence& presence) {
    return std::ranges::includes(names_in(presence), names);
  });
}

}  // namespace hlc::dds
