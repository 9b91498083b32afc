#pragma once

#include <cstdint>
#include <filesystem>
#include <list>
#include <optional>
#include <string>
#include <vector>

#include "hlc_bridge/dds/participant.hpp"
#include "hlc_bridge/dds/reader.hpp"
#include "hlc_bridge/dds/transport.hpp"
#include "hlc_bridge/messages/messages.hpp"
#include "hlc_bridge/messages/run_messages.hpp"
#include "hlc_bridge/time/signal.hpp"

namespace hlc::live {

struct ListenerOptions {
  dds::Transport transport{dds::Transport::kLab};
  int lab_domain{};
  int controller_domain{};
  Nanoseconds lease{};
  std::optional<dds::DiscoveryServer> discovery_server;
  std::filesystem::path security{};           ///< ParticipantOptions
  std::vector<std::string> controller_peers;  ///< ParticipantOptions::peers
  std::vector<std::uint8_t> vehicle_ids;
  std::vector<std::uint8_t> guest_ids{};  ///< further vehicles, without controllers
};

/// Listens to the reports and states of a run, and publishes nothing. No process of the run waits
/// for it: their writers keep the last messages only, and who has to be there is known by name.
class LabListener {
 public:
  /// @throws std::invalid_argument, std::runtime_error if a domain cannot be joined
  explicit LabListener(const ListenerOptions& options);

  struct Received {
    std::vector<ReportRecord> reports;  ///< of a controller: all of the run, in order
    std::vector<VehicleState> states;   ///< those since this listener has joined
  };
  /// What has arrived since the last call.
  [[nodiscard]] Received take();

  /// The lab control has left, or all controllers have.
  [[nodiscard]] bool run_is_over() const;

 private:
  time::Signal signal_;
  Received received_;  ///< guarded by signal_
  std::vector<std::uint8_t> vehicle_ids_;
  dds::Participant lab_;
  dds::Participant controllers_;
  dds::Reader<ReportRecord> reports_;
  std::list<dds::Reader<VehicleState>> states_;
};

}  // namespace hlc::live
