#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "hlc_bridge/dds/transport.hpp"
#include "hlc_bridge/doctor/diagnosis.hpp"

namespace hlc::doctor {

struct ListenOptions {
  dds::Transport transport{dds::Transport::kLab};
  dds::Domains domains;  ///< local: empty if the middleware is not to be checked
  std::optional<dds::DiscoveryServer> discovery_server;
  std::filesystem::path security{};  ///< ParticipantOptions
  /// ParticipantOptions::peers of the controllers' domain
  std::vector<std::string> controller_peers;
  std::chrono::milliseconds time{3000};
};

/// Joins the domains and listens, for `time` at most, until `is_enough(received so far)`. Publishes
/// nothing but requests for the lab control's period: a run is not disturbed.
/// @throws std::invalid_argument, std::runtime_error if a domain cannot be joined
[[nodiscard]] Received listen(const ListenOptions& options,
                              const std::function<bool(const Received&)>& is_enough);

}  // namespace hlc::doctor
