#pragma once

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <chrono>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "hlc_bridge/apps/log_flag.hpp"
#include "hlc_bridge/dds/transport.hpp"
#include "hlc_bridge/messages/exit_codes.hpp"
#include "planner/apps/flags.hpp"
#include "planner/coordination/messages.hpp"

/// Flags that the processes of a run have in common, as in the lab: `--name=value` and `--name
/// value`.
namespace hlc::apps {

[[nodiscard]] inline CLI::Validator vehicle_id_range() { return whole(1, kMaxLabVehicleId); }

/// The lab's default.
inline constexpr const char* kDiscoveryServerId = "44.53.00.5f.45.50.52.4f.53.49.4d.41";
inline constexpr const char* kDiscoveryServerPort = "11811";

/// Machines asked on the controllers' domain where multicast does not pass.
inline void declare_controller_peers(CLI::App& app, std::vector<std::string>& peers) {
  app.add_option("--controller_peers", peers,
                 "IPv4 addresses of the other machines, asked on the controllers' domain besides "
                 "multicast, e.g. 192.168.1.201,192.168.1.202; default: none")
      ->delimiter(',');
}

inline void declare_transport(CLI::App& app, std::string& transport) {
  app.add_option("--transport", transport,
                 "lab: as the lab's own programs; loopback: nothing leaves this machine")
      ->check(among({"lab", "loopback"}))
      ->capture_default_str();
}

struct NetworkFlags {
  bool simulated_time{false};
  int dds_domain{0};
  std::string transport{"lab"};
  std::string discovery_mode;
  std::string discovery_server_id;
  std::string discovery_server_ip;
  std::string discovery_server_port;
  std::filesystem::path security;
  int startup_timeout_s{30};
  std::filesystem::path messages;

  void declare(CLI::App& app) {
    app.add_option("--simulated_time", simulated_time, "true: logical time, false: real time")
        ->capture_default_str();
    declare_network(app);
    app.add_option("--startup_timeout_s", startup_timeout_s,
                   "exit code 3 if a participant is missing by then; on the lab's transport "
                   "controllers wait for the start without a limit")
        ->capture_default_str()
        ->check(whole(1, 3600));
    app.add_option("--messages_folder", messages,
                   "every message that this process publishes is recorded there, in an MCAP file "
                   "of its own; default: none")
        ->type_name("DIR");
  }

  /// The flags that do not concern a run.
  void declare_network(CLI::App& app) {
    app.add_option("--dds_domain", dds_domain, "lab domain")->capture_default_str();
    declare_transport(app, transport);
    app.add_option("--discovery_mode", discovery_mode,
                   "simple: multicast; client: by the lab domain's discovery server (default: "
                   "simple)")
        ->check(among({"simple", "client"}));
    app.add_option("--discovery_server_id", discovery_server_id,
                   std::string("GUID prefix; default, as in the lab: ") + kDiscoveryServerId);
    app.add_option("--discovery_server_ip", discovery_server_ip,
                   "IPv4 address; required with client");
    app.add_option("--discovery_server_port", discovery_server_port,
                   std::string("UDP port; default, as in the lab: ") + kDiscoveryServerPort);
    app.add_option("--security", security,
                   "folder of make_security.sh: DDS security, only with processes of the same "
                   "folder; default: none")
        ->envname("HLC_SECURITY")
        ->type_name("DIR");
    declare_log_level(app);
  }

  /// @throws std::invalid_argument naming the flag
  [[nodiscard]] std::optional<dds::DiscoveryServer> discovery_server() const {
    const bool is_client = discovery_mode == "client";
    const auto given = [is_client](const std::string& value, const char* otherwise) {
      return is_client && value.empty() ? std::string(otherwise) : value;
    };
    return dds::discovery_from_flags(discovery_mode, given(discovery_server_id, kDiscoveryServerId),
                                     discovery_server_ip,
                                     given(discovery_server_port, kDiscoveryServerPort));
  }
  [[nodiscard]] std::chrono::seconds startup_timeout() const {
    return std::chrono::seconds{startup_timeout_s};
  }
};

/// Of the flags of the programs that the lab starts.
inline const std::vector<FormerName> kFormerLabNames{{"--messages", "--messages_folder"},
                                                     {"--dump-problems", "--dump_problems"}};

/// parse_flags for the programs that the lab starts. On the lab's transport they ignore unknown
/// flags with a warning, as the lab's own programs do: the lab appends the operator's script
/// parameters to the middleware's command line.
/// @param network  of the parsed flags
inline std::optional<int> parse_lab_flags(CommandLine& app, const NetworkFlags& network, int argc,
                                          char** argv) {
  app.allow_extras();
  if (const auto code = parse_flags(app, argc, argv, kFormerLabNames)) return code;
  const std::vector<std::string> unknown = app.remaining();
  if (unknown.empty()) return std::nullopt;
  if (network.transport == "lab") {
    spdlog::warn(fmt::format("{}: unknown flags ignored: {}", app.get_name(),
                             one_line(fmt::format("{}", fmt::join(unknown, " ")), 200)));
    return std::nullopt;
  }
  return refuse_unknown(app, CLI::ExtrasError(unknown));
}

}  // namespace hlc::apps
