// The high-level controller of one vehicle. Started by the lab control centre with the lab's flags,
// or by launch_scripts/vehicle.sh.
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <exception>
#include <filesystem>
#include <string>

#include "hlc_bridge/hlc/hlc_process.hpp"
#include "hlc_bridge/time/stop_signals.hpp"
#include "planner/scenario/scenario.hpp"

namespace {

struct Flags {
  std::string node_id;
  bool simulated_time{false};
  std::vector<int> vehicle_ids;
  int dds_domain{0};
  int middleware_domain{1};
  int controller_domain{-1};
  std::string transport{"lab"};
  std::string discovery_mode;
  std::string discovery_server_id;
  std::string discovery_server_ip;
  std::string discovery_server_port;
  int startup_timeout_s{30};
  hlc::ScenarioChoices scenario;
};

void declare(CLI::App& app, Flags& flags) {
  app.add_option("--vehicle_ids", flags.vehicle_ids, "vehicle to control (one id)")
      ->delimiter(',')
      ->required()
      ->expected(1)
      ->check(CLI::Range(1, 30));
  app.add_option("--scenario", flags.scenario.file, "scenario file (YAML)")->required();
  app.add_option("--profile", flags.scenario.profile, "rules: default or 2022")
      ->capture_default_str();
  app.add_option("--subgraph", flags.scenario.subgraph, "instead of the scenario's");
  app.add_option("--map", flags.scenario.map_file, "CommonRoad XML instead of the scenario's");
  app.add_option("--cars", flags.scenario.cars, "number of cars (scenarios on a circle)");
  app.add_option("--node_id", flags.node_id, "default: high_level_controller_<id>");
  app.add_option("--simulated_time", flags.simulated_time, "true: logical time, false: real time")
      ->capture_default_str();
  app.add_option("--dds_domain", flags.dds_domain, "lab domain")->capture_default_str();
  app.add_option("--middleware_domain", flags.middleware_domain, "local domain")
      ->capture_default_str();
  app.add_option("--controller_domain", flags.controller_domain,
                 "domain of the controllers; default: lab domain + 50");
  app.add_option("--transport", flags.transport, "lab or loopback")->capture_default_str();
  app.add_option("--discovery_mode", flags.discovery_mode, "simple or client");
  app.add_option("--discovery_server_id", flags.discovery_server_id, "GUID prefix");
  app.add_option("--discovery_server_ip", flags.discovery_server_ip, "IPv4 address");
  app.add_option("--discovery_server_port", flags.discovery_server_port, "port");
  app.add_option("--startup_timeout_s", flags.startup_timeout_s,
                 "exit code 3 if somebody is not there by then")
      ->capture_default_str()
      ->check(CLI::Range(1, 3600));
  app.footer("Exit codes: 0 good, 2 bad input, 3 somebody did not appear, 4 the middleware died.");
}

hlc::HlcProcessOptions process_options(const Flags& flags, hlc::VehicleId id) {
  hlc::HlcProcessOptions options;
  options.node_id = flags.node_id.empty() ? hlc::controller_node_id(id) : flags.node_id;
  options.transport = hlc::transport_from_name(flags.transport);
  const int controller_domain = flags.controller_domain >= 0
                                    ? flags.controller_domain
                                    : hlc::default_controller_domain(flags.dds_domain);
  options.domains = {
      .lab = flags.dds_domain, .local = flags.middleware_domain, .controller = controller_domain};
  for (const std::string& warning : hlc::check_domains(options.domains, options.transport)) {
    spdlog::warn("{}: {}", options.node_id, warning);
  }
  options.discovery_server =
      hlc::discovery_from_flags(flags.discovery_mode, flags.discovery_server_id,
                                flags.discovery_server_ip, flags.discovery_server_port);
  options.logical_time = flags.simulated_time;
  options.startup_timeout = std::chrono::seconds(flags.startup_timeout_s);
  return options;
}

int run(const Flags& flags, hlc::StopSignals& signals) {
  const hlc::VehicleId id{static_cast<std::uint8_t>(flags.vehicle_ids.front())};
  const hlc::HlcProcessOptions options = process_options(flags, id);
  const hlc::Scenario scenario = hlc::read_scenario(flags.scenario);
  hlc::HlcProcess process(options, hlc::make_controller(scenario, id));
  signals.on_stop([&process](int) { process.stop(); });
  return process.run();
}

}  // namespace

int main(int argc, char** argv) {
  hlc::StopSignals signals;
  CLI::App app{"High-level controller: plans one vehicle's motion and agrees with the others."};
  Flags flags;
  declare(app, flags);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  try {
    return run(flags, signals);
  } catch (const std::exception& error) {
    spdlog::error("{}", error.what());
    return 2;
  }
}
