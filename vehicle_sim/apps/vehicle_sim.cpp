// One simulated µCar as a process on the lab domain. Started by launch_scripts/vehicle.sh, with the
// flags of the lab's vehicle and ours.
#include <cstdint>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "hlc_bridge/apps/flags.hpp"
#include "hlc_bridge/apps/program_version.hpp"
#include "hlc_bridge/apps/run_program.hpp"
#include "vehicle_sim/apps/start_pose.hpp"
#include "vehicle_sim/apps/vehicle_process.hpp"

namespace {

constexpr double kMaxGainsScale = 10.0;

struct Flags {
  hlc::apps::NetworkFlags network;
  int vehicle_id{};
  std::vector<double> pose;
  std::optional<std::uint64_t> noise_seed;
  double gains_scale{1.0};
  std::string record;
  bool append_record{};
  bool keep_running{false};
};

void declare(CLI::App& app, Flags& flags) {
  app.add_option("--vehicle_id", flags.vehicle_id, "1 ... 30")
      ->required()
      ->check(hlc::apps::vehicle_id_range());
  flags.network.declare(app);
  app.add_option("--pose", flags.pose, "x,y,yaw at the start [m, m, rad]; needed for ids above 23")
      ->delimiter(',')
      ->expected(3);
  app.add_option("--noise_seed", flags.noise_seed,
                 "measure the pose with the lab's noise (2 mm, 0.01 rad); default: exactly")
      ->check(hlc::apps::whole(0, std::numeric_limits<std::uint64_t>::max()));
  app.add_option("--gains_scale", flags.gains_scale, "factor on the follower's gains; 0: no motion")
      ->capture_default_str()
      ->check(hlc::apps::within(0.0, kMaxGainsScale));
  CLI::Option* const record =
      app.add_option("--record", flags.record, "CSV file for the true motion, one row per tick");
  app.add_flag("--append_record", flags.append_record,
               "append to the record of a process that ended before")
      ->needs(record);
  app.add_flag("--keep_running", flags.keep_running,
               "listen again after a stop, as the lab's vehicle does");
  app.footer(
      "In real time the car waits for commands without a time limit, as the lab's does "
      "(--startup_timeout_s counts in logical time).\n"
      "Exit codes: 0 success, 2 invalid input, 3 startup timeout, 4 the lab control died.");
}

hlc::apps::VehicleProcessOptions process_options(const Flags& flags) {
  const auto id = static_cast<std::uint8_t>(flags.vehicle_id);
  hlc::dds::check_domain_id("--dds_domain", flags.network.dds_domain);
  const hlc::Nanoseconds grace = flags.keep_running ? hlc::machine::kForever : hlc::kVehicleStays;
  return {.vehicle = {.vehicle_id = id,
                      .start = hlc::apps::start_pose(id, flags.pose),
                      .noise_seed = flags.noise_seed,
                      .gains = scaled(hlc::tracking::FollowerGains{}, flags.gains_scale)},
          .version = hlc::apps::program_version(),
          .transport = hlc::dds::transport_from_name(flags.network.transport),
          .lab_domain = flags.network.dds_domain,
          .discovery_server = flags.network.discovery_server(),
          .time = hlc::machine::run_time(flags.network.simulated_time),
          .rules = flags.network.simulated_time ? hlc::machine::logical_rules()
                                                : hlc::machine::real_rules(grace),
          .keep_running = flags.keep_running,
          .ticks_by_period = flags.network.simulated_time && flags.network.transport == "loopback" &&
                             !flags.keep_running,
          .startup_timeout = flags.network.startup_timeout(),
          .record_file = flags.record,
          .append_record = flags.append_record};
}

}  // namespace

int main(int argc, char** argv) {
  hlc::time::StopSignals signals;
  CLI::App app{"A simulated µCar: follows commands and publishes its state, every 20 ms.",
               "vehicle_sim"};
  Flags flags;
  declare(app, flags);
  if (const auto code = hlc::apps::parse_flags(app, argc, argv, hlc::kExitBadInput)) return *code;
  return hlc::apps::run_program(
      "vehicle_sim", signals,
      [&] { return std::make_shared<hlc::apps::VehicleProcess>(process_options(flags)); },
      [](hlc::apps::VehicleProcess& process) { process.stop(); });
}
