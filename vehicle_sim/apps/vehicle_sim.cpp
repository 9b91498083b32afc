// Simulated µCars as a process on the lab domain, one or several. Started by
// launch_scripts/vehicle.sh, with the flags of the lab's vehicle and ours.
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "hlc_bridge/apps/flags.hpp"
#include "hlc_bridge/apps/message_recording.hpp"
#include "hlc_bridge/apps/program_version.hpp"
#include "hlc_bridge/apps/run_program.hpp"
#include "planner/scenario/guest_values.hpp"
#include "planner/scenario/vehicle_model.hpp"
#include "vehicle_sim/apps/start_pose.hpp"
#include "vehicle_sim/apps/vehicle_process.hpp"
#include "vehicle_sim/closed_loop/guest_vehicle.hpp"

namespace {

constexpr double kMaxGainsScale = 10.0;

struct Flags {
  hlc::apps::NetworkFlags network;
  std::vector<int> vehicle_ids;
  std::vector<double> pose;
  std::vector<std::uint64_t> noise_seeds;
  double gains_scale{1.0};
  std::string stamps{"exact"};
  std::string scenario;
  std::string record;
  bool append_record{};
  bool keep_running{false};
};

void declare(CLI::App& app, Flags& flags) {
  app.add_option("--vehicle_ids,--vehicle_id", flags.vehicle_ids,
                 "1 ... 30; several, such as 1,2, are one process")
      ->delimiter(',')
      ->required()
      ->check(hlc::apps::vehicle_id_range());
  flags.network.declare(app);
  app.add_option("--pose", flags.pose,
                 "x,y,yaw at the start [m, m, rad], of each vehicle; default: where the lab's "
                 "simulated vehicle of its id stands, "
                 "required for ids above 23")
      ->delimiter(',');
  app.add_option("--noise_seed", flags.noise_seeds,
                 "measure the pose with the lab's noise (2 mm, 0.01 rad), one seed for each "
                 "vehicle; default: exactly")
      ->delimiter(',')
      ->check(hlc::apps::whole(0, std::numeric_limits<std::uint64_t>::max()));
  app.add_option("--gains_scale", flags.gains_scale, "factor on the follower's gains; 0: no motion")
      ->capture_default_str()
      ->check(hlc::apps::within(0.0, kMaxGainsScale));
  app.add_option("--stamps", flags.stamps,
                 "exact: a state shows the pose of its stamp; lab: as the lab's simulated vehicle, "
                 "which follows by its own controller and shows the pose 20 ms after the stamp")
      ->capture_default_str()
      ->check(CLI::IsMember({"exact", "lab"}));
  app.add_option("--scenario", flags.scenario,
                 "scenario file: the vehicles move as its automaton's, and its guests start and "
                 "drive as it states; default: the lab's µCars, without guests")
      ->type_name("FILE");
  CLI::Option* const record =
      app.add_option("--record", flags.record,
                     "CSV file for the true motion, one row per tick; with several vehicles one "
                     "each: {id} stands for the number; default: none")
          ->type_name("FILE");
  app.add_flag("--append_record", flags.append_record,
               "append to the record of a process that ended before")
      ->needs(record);
  app.add_flag("--keep_running", flags.keep_running,
               "listen again after a stop, as the lab's vehicle does");
  hlc::apps::declare_help_end(
      app, {.examples = {"vehicle_sim --vehicle_ids 1 --dds_domain 40 --transport loopback",
                         "vehicle_sim --vehicle_ids 1,2 --simulated_time true --noise_seed 1,2 "
                         "--record vehicle_{id}.csv"},
            .exit_codes = "0 success, 1 success, but --record or --messages_folder is incomplete, "
                          "2 invalid input, 3 startup timeout, 4 the lab control died",
            .notes = "In real time the car waits for commands without a time limit, as the lab's "
                     "does (--startup_timeout_s counts in logical time)."});
}

/// The part of a list with `size` values for each of `vehicles` that belongs to vehicle `index`.
/// @throws std::invalid_argument naming the flag
template <class Value>
std::vector<Value> share_of(const char* flag, const std::vector<Value>& all, std::size_t index,
                            std::size_t size, std::size_t vehicles) {
  if (all.empty()) return {};
  if (all.size() != size * vehicles) {
    throw std::invalid_argument(fmt::format("{}: {} numbers, must be {} for each of {} vehicles",
                                            flag, all.size(), size, vehicles));
  }
  const auto begin = all.begin() + static_cast<std::ptrdiff_t>(index * size);
  return {begin, begin + static_cast<std::ptrdiff_t>(size)};
}

std::vector<hlc::scenario::ScenarioGuest> guests(const Flags& flags) {
  if (flags.scenario.empty()) return {};
  return hlc::scenario::guests_of_file(flags.scenario);
}

std::vector<hlc::simulated_vehicle::SimulatedVehicleOptions> vehicles(
    const Flags& flags, const std::vector<hlc::scenario::ScenarioGuest>& guests) {
  hlc::apps::check_each_once("--vehicle_ids", flags.vehicle_ids);
  const bool is_as_in_lab = flags.stamps == "lab";
  if (is_as_in_lab && flags.gains_scale != 1.0) {
    throw std::invalid_argument(fmt::format(
        "--gains_scale = {}, must be 1 with --stamps = lab: its controller has no gains",
        flags.gains_scale));
  }
  const hlc::vehicle::IdentifiedVehicle model =
      flags.scenario.empty() ? hlc::vehicle::IdentifiedVehicle{}
                             : hlc::scenario::vehicle_model_of_file(flags.scenario);
  const std::size_t count = flags.vehicle_ids.size();
  std::vector<hlc::simulated_vehicle::SimulatedVehicleOptions> vehicles;
  for (std::size_t i = 0; i < count; ++i) {
    const auto id = static_cast<std::uint8_t>(flags.vehicle_ids[i]);
    const auto seeds = share_of("--noise_seed", flags.noise_seeds, i, 1, count);
    const auto seed = seeds.empty() ? std::nullopt : std::optional(seeds.front());
    const auto stamps = is_as_in_lab ? hlc::simulated_vehicle::Stamps::kLab
                                     : hlc::simulated_vehicle::Stamps::kExact;
    const auto guest = std::ranges::find(guests, id, [](const hlc::scenario::ScenarioGuest& one) {
      return one.guest.vehicle.value;
    });
    if (guest != guests.end()) {
      vehicles.push_back(hlc::closed_loop::guest_vehicle(*guest, seed, stamps));
      continue;
    }
    vehicles.push_back(
        {.vehicle_id = id,
         .start = hlc::apps::start_pose(id, share_of("--pose", flags.pose, i, 3, count)),
         .noise_seed = seed,
         .gains = scaled(hlc::tracking::FollowerGains{}, flags.gains_scale),
         .vehicle = model,
         .stamps = stamps});
  }
  return vehicles;
}

std::vector<std::string> record_files(const Flags& flags) {
  constexpr std::string_view kPlace = "{id}";
  std::vector<std::string> files;
  if (flags.record.empty()) return files;
  const std::size_t place = flags.record.find(kPlace);
  if (place == std::string::npos && flags.vehicle_ids.size() > 1) {
    throw std::invalid_argument("--record = " + flags.record +
                                ", must contain {id} with several vehicles");
  }
  for (const int id : flags.vehicle_ids) {
    files.push_back(flags.record);
    if (place != std::string::npos) {
      files.back().replace(place, kPlace.size(), std::to_string(id));
    }
  }
  return files;
}

hlc::apps::VehicleProcessOptions process_options(const Flags& flags) {
  hlc::dds::check_domain_id("--dds_domain", flags.network.dds_domain);
  const hlc::Nanoseconds grace = flags.keep_running ? hlc::machine::kForever : hlc::kVehicleStays;
  const std::vector<hlc::scenario::ScenarioGuest> guests = ::guests(flags);
  std::vector<std::uint8_t> guest_ids;
  for (const hlc::scenario::ScenarioGuest& one : guests) {
    guest_ids.push_back(one.guest.vehicle.value);
  }
  return {.vehicles = vehicles(flags, guests),
          .guest_ids = std::move(guest_ids),
          .version = hlc::apps::program_version(),
          .transport = hlc::dds::transport_from_name(flags.network.transport),
          .lab_domain = flags.network.dds_domain,
          .discovery_server = flags.network.discovery_server(),
          .security = flags.network.security,
          .time = hlc::machine::run_time(flags.network.simulated_time,
                                         flags.network.transport == "lab"),
          .rules = flags.network.simulated_time ? hlc::machine::logical_rules()
                                                : hlc::machine::real_rules(grace),
          .keep_running = flags.keep_running,
          .ticks_by_period = flags.network.simulated_time &&
                             flags.network.transport == "loopback" && !flags.keep_running,
          .startup_timeout = flags.network.startup_timeout(),
          .record_files = record_files(flags),
          .append_record = flags.append_record};
}

}  // namespace

int main(int argc, char** argv) {
  hlc::time::StopSignals signals;
  hlc::apps::CommandLine app{
      "Simulated µCars: follow commands and publish their states, every 20 ms.", "vehicle_sim"};
  Flags flags;
  declare(app, flags);
  if (const auto code = hlc::apps::parse_lab_flags(app, flags.network, argc, argv)) return *code;
  hlc::apps::MessageRecording recording;
  const auto make = [&] {
    hlc::apps::VehicleProcessOptions options = process_options(flags);
    options.on_published =
        recording.open(flags.network.messages, flags.network.simulated_time,
                       fmt::format("vehicle_sim_{}", fmt::join(flags.vehicle_ids, ",")));
    return std::make_shared<hlc::apps::VehicleProcess>(options);
  };
  return hlc::apps::run_program(
      "vehicle_sim", signals, make, [](hlc::apps::VehicleProcess& process) { process.stop(); },
      [&](int exit_code) { return recording.close(exit_code); });
}
