#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <set>
#include <string>

#include "hlc_bridge/dds/participant_core.hpp"

namespace hlc::dds {

/// The readers matched with a writer, or the writers matched with a reader; without those of the
/// own participant. Only sources of this folder include this file.
class EndpointPeers {
 public:
  /// `kind`: of the peers. `on_change` is called after every change, until close.
  static std::shared_ptr<EndpointPeers> create(const std::shared_ptr<ParticipantCore>& core,
                                               PeerKind kind, const std::string& topic,
                                               std::function<void()> on_change);

  /// From the library's matched callback.
  void on_matched(const fdds::MatchedStatus& status, const frtps::InstanceHandle_t& last_peer);
  void notify();
  void close() { gate_.close(); }

  [[nodiscard]] std::size_t count() const;
  [[nodiscard]] std::set<std::string> names() const;
  [[nodiscard]] bool wait_for(std::size_t count,
                              std::chrono::steady_clock::time_point deadline) const;
  [[nodiscard]] bool wait_for(const std::set<std::string>& names,
                              std::chrono::steady_clock::time_point deadline) const;

 private:
  EndpointPeers(ParticipantCore& core, PeerKind kind, std::string topic,
                std::function<void()> on_change);
  [[nodiscard]] std::set<std::string> names_in(const Presence& presence) const;

  ParticipantCore& core_;  ///< outlives this: the endpoint holds both
  PeerKind kind_;
  std::string topic_;
  std::function<void()> on_change_;
  Gate gate_;
  std::set<frtps::GUID_t> peers_;  ///< guarded by the core's lock
};

}  // namespace hlc::dds
