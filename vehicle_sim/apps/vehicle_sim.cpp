// One simulated µCar as a process on the lab domain. Started by launch_scripts/vehicle.sh, with the
// flags of the lab's vehicle and ours.
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <cstdint>
#include <exception>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "hlc_bridge/time/exit_watchdog.hpp"
#include "hlc_bridge/time/stop_signals.hpp"
#include "vehicle_sim/apps/start_pose.hpp"
#include "vehicle_sim/apps/vehicle_process.hpp"

namespace {

constexpr double kMaxGainsScale = 10.0;

struct Flags {
  int vehicle_id{};
  bool simulated_time{false};
  int dds_domain{0};
  std::vector<double> pose;
  std::string transport{"lab"};
  std::string discovery_mode;
  std::string discovery_server_id;
  std::string discovery_server_ip;
  std::string discovery_server_port;
  std::optional<std::uint64_t> noise_seed;
  double gains_scale{1.0};
  std::string record;
  int startup_timeout_s{30};
  bool keep_running{false};
};

void declare(CLI::App& app, Flags& flags) {
  app.add_option("--vehicle_id", flags.vehicle_id, "1 ... 30")
      ->required()
      ->check(CLI::Range(1, 30));
  app.add_option("--simulated_time", flags.simulated_time, "true: logical time, false: real time")
      ->capture_default_str();
  app.add_option("--dds_domain", flags.dds_domain, "lab domain")->capture_default_str();
  app.add_option("--pose", flags.pose, "x,y,yaw at the start [m, m, rad]; needed for ids above 23")
      ->delimiter(',')
      ->expected(3);
  app.add_option("--transport", flags.transport, "lab or loopback")->capture_default_str();
  app.add_option("--discovery_mode", flags.discovery_mode, "simple or client");
  app.add_option("--discovery_server_id", flags.discovery_server_id, "GUID prefix");
  app.add_option("--discovery_server_ip", flags.discovery_server_ip, "IPv4 address");
  app.add_option("--discovery_server_port", flags.discovery_server_port, "port");
  app.add_option("--noise_seed", flags.noise_seed,
                 "measure the pose with the lab's noise (2 mm, 0.01 rad); default: exactly")
      ->check(CLI::NonNegativeNumber);
  app.add_option("--gains_scale", flags.gains_scale, "factor on the follower's gains; 0: no motion")
      ->capture_default_str();
  app.add_option("--record", flags.record, "CSV file for what is truly driven, one row per tick");
  app.add_option("--startup_timeout_s", flags.startup_timeout_s,
                 "exit code 3 if somebody is not there by then")
      ->capture_default_str()
      ->check(CLI::Range(1, 3600));
  app.add_flag("--keep_running", flags.keep_running,
               "listen again after a stop, as the lab's vehicle does");
  app.footer("Exit codes: 0 good, 2 bad input, 3 somebody did not appear, 4 the lab control died.");
}

hlc::VehicleProcessOptions process_options(const Flags& flags) {
  const auto id = static_cast<std::uint8_t>(flags.vehicle_id);
  hlc::check_domain_id("--dds_domain", flags.dds_domain);
  if (!(flags.gains_scale >= 0.0 && flags.gains_scale <= kMaxGainsScale)) {
    throw std::invalid_argument("--gains_scale: " + std::to_string(flags.gains_scale) +
                                " is not allowed, 0 to 10");
  }
  return {.vehicle = {.vehicle_id = id,
                      .start = hlc::start_pose(id, flags.pose),
                      .noise_seed = flags.noise_seed,
                      .gains = scaled(hlc::FollowerGains{}, flags.gains_scale)},
          .transport = hlc::transport_from_name(flags.transport),
          .lab_domain = flags.dds_domain,
          .discovery_server =
              hlc::discovery_from_flags(flags.discovery_mode, flags.discovery_server_id,
                                        flags.discovery_server_ip, flags.discovery_server_port),
          .logical_time = flags.simulated_time,
          .keep_running = flags.keep_running,
          .startup_timeout = std::chrono::seconds(flags.startup_timeout_s),
          .record_file = flags.record};
}

int run(const Flags& flags, hlc::StopSignals& signals) {
  // Shared with the signals' thread, which lives longer than this function.
  const auto process = std::make_shared<hlc::VehicleProcess>(process_options(flags));
  signals.on_stop([process](int) { process->stop(); });
  return hlc::run_to_the_end(*process);
}

}  // namespace

int main(int argc, char** argv) {
  hlc::StopSignals signals;
  CLI::App app{"A simulated µCar: drives what it is commanded and tells its state, every 20 ms."};
  Flags flags;
  declare(app, flags);
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp& help) {
    return app.exit(help);
  } catch (const CLI::ParseError& error) {
    spdlog::error("{}", error.what());
    return hlc::kExitBadInput;
  }
  try {
    return run(flags, signals);
  } catch (const std::exception& error) {
    spdlog::error("{}", error.what());
    return hlc::kExitBadInput;
  }
}
