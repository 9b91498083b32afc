#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "hlc_bridge/core/exit_codes.hpp"
#include "hlc_bridge/dds/transport.hpp"
#include "planner/apps/flags.hpp"
#include "planner/coordination/messages.hpp"

/// Flags that the processes of a run have in common, as in the lab: `--name=value` and `--name
/// value`.
namespace hlc {

[[nodiscard]] inline CLI::Range vehicle_id_range() { return {1, static_cast<int>(kMaxVehicleId)}; }

/// Who is asked on the controllers' domain where multicast does not pass.
inline void declare_controller_peers(CLI::App& app, std::vector<std::string>& peers) {
  app.add_option("--controller_peers", peers,
                 "IPv4 addresses of the other machines, asked on the controllers' domain besides "
                 "multicast, e.g. 192.168.1.201,192.168.1.202")
      ->delimiter(',');
}

struct NetworkFlags {
  bool simulated_time{false};
  int dds_domain{0};
  std::string transport{"lab"};
  std::string discovery_mode;
  std::string discovery_server_id;
  std::string discovery_server_ip;
  std::string discovery_server_port;
  int startup_timeout_s{30};

  void declare(CLI::App& app) {
    app.add_option("--simulated_time", simulated_time, "true: logical time, false: real time")
        ->capture_default_str();
    declare_network(app);
    app.add_option("--startup_timeout_s", startup_timeout_s,
                   "exit code 3 if somebody is not there by then")
        ->capture_default_str()
        ->check(CLI::Range(1, 3600));
  }

  /// Without what only a run needs.
  void declare_network(CLI::App& app) {
    app.add_option("--dds_domain", dds_domain, "lab domain")->capture_default_str();
    app.add_option("--transport", transport, "lab or loopback")->capture_default_str();
    app.add_option("--discovery_mode", discovery_mode, "simple or client");
    app.add_option("--discovery_server_id", discovery_server_id, "GUID prefix");
    app.add_option("--discovery_server_ip", discovery_server_ip, "IPv4 address");
    app.add_option("--discovery_server_port", discovery_server_port, "port");
  }

  /// @throws std::invalid_argument naming the flag
  [[nodiscard]] std::optional<DiscoveryServer> discovery_server() const {
    return discovery_from_flags(discovery_mode, discovery_server_id, discovery_server_ip,
                                discovery_server_port);
  }
  [[nodiscard]] std::chrono::seconds startup_timeout() const {
    return std::chrono::seconds{startup_timeout_s};
  }
};

}  // namespace hlc
