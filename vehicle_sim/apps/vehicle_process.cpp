#include "vehicle_sim/apps/vehicle_process.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <type_traits>
#include <utility>
#include <variant>

#include "hlc_bridge/messages/exit_codes.hpp"
#include "hlc_bridge/messages/node_names.hpp"
#include "hlc_bridge/messages/time_grid.hpp"

namespace hlc::apps {
namespace {

using simulated_vehicle::OfVehicle;
using simulated_vehicle::SimulatedVehicleOptions;
using simulated_vehicle::VehicleMachine;

std::string name_of(const VehicleProcessOptions& options) {
  std::vector<std::uint8_t> ids;
  for (const SimulatedVehicleOptions& vehicle : options.vehicles) ids.push_back(vehicle.vehicle_id);
  return vehicle_name(ids);
}

simulated_vehicle::VehicleFleet fleet(const VehicleProcessOptions& options) {
  std::vector<simulated_vehicle::VehicleMachineOptions> machines;
  for (const SimulatedVehicleOptions& vehicle : options.vehicles) {
    machines.push_back({.vehicle = vehicle,
                        .rules = options.rules,
                        .is_among_lab_programs = options.transport == dds::Transport::kLab,
                        .guest_ids = options.guest_ids,
                        .keep_running = options.keep_running,
                        .ticks_by_period = options.ticks_by_period,
                        .startup_timeout = time::nanoseconds(options.startup_timeout)});
  }
  return simulated_vehicle::VehicleFleet(machines);
}

std::vector<run_folder::DriveRecorder> recorders(const VehicleProcessOptions& options,
                                                 const std::string& name) {
  std::vector<run_folder::DriveRecorder> recorders;
  for (const std::string& file : options.record_files) {
    recorders.emplace_back(
        file, [name](const std::string& line) { process::log(name, machine::warning(line)); },
        options.append_record);
  }
  return recorders;
}

}  // namespace

struct VehicleProcess::Vehicle {
  Vehicle(VehicleProcess& process, std::size_t index)
      : id{process.options_.vehicles.at(index).vehicle_id},
        name{vehicle_name(id)},
        state{process.lab_, dds::topics::vehicle_state(id), on_presence(process)},
        trajectory{reader<TrajectoryCommand>(process, id)} {
    if (!process.recorders_.empty()) recorder = &process.recorders_.at(index);
    const bool is_in_lab = process.options_.transport == dds::Transport::kLab;
    if (is_in_lab) {
      observation.emplace(process.lab_, dds::topics::vehicle_observation(id));
      path_tracking = reader<PathTrackingCommand>(process, id);
    }
    if (!is_in_lab && std::ranges::count(process.options_.guest_ids, id) == 0) return;
    speed_curvature = reader<SpeedCurvatureCommand>(process, id);
    direct = reader<DirectCommand>(process, id);
  }

  static std::function<void()> on_presence(VehicleProcess& process) {
    return [&process] { process.shell_.presence_changed(); };
  }
  template <class Command>
  static std::unique_ptr<dds::Reader<Command>> reader(VehicleProcess& process, std::uint8_t id) {
    return std::make_unique<dds::Reader<Command>>(
        process.lab_, dds::topics::vehicle_command<Command>(id),
        [&process, id](const Command& command) {
          process.shell_.post(OfVehicle<VehicleMachine::Event>{id, command});
        },
        on_presence(process),
        dds::only_on_loopback<Command>(
            process.options_.transport,
            std::is_same_v<Command, TrajectoryCommand> ? middleware_name(id) : driver_name(id)));
  }

  void perform(const ParameterRequest& /*request*/) {}  // the fleet's
  void perform(const VehicleState& message) { state.write(message); }
  void perform(const VehicleObservation& message) {
    if (observation) observation->write(message);
  }
  void perform(const result::DrivenSample& sample) {
    if (recorder != nullptr) recorder->write(sample);
  }
  void perform(const machine::LogLine& line) { process::log(name, line); }

  std::uint8_t id;
  std::string name;
  run_folder::DriveRecorder* recorder{};
  dds::Writer<VehicleState> state;
  std::unique_ptr<dds::Reader<TrajectoryCommand>> trajectory;
  // What only the lab's programs send and receive: on the lab's transport; the last two also for a
  // guest, from who drives it by hand.
  std::optional<dds::Writer<VehicleObservation>> observation;
  std::unique_ptr<dds::Reader<PathTrackingCommand>> path_tracking;
  std::unique_ptr<dds::Reader<SpeedCurvatureCommand>> speed_curvature;
  std::unique_ptr<dds::Reader<DirectCommand>> direct;
};

VehicleProcess::VehicleProcess(VehicleProcessOptions options)
    : options_(std::move(options)),
      name_(name_of(options_)),
      recorders_(recorders(options_, name_)),
      shell_(name_, fleet(options_),
             options_.time.make_pacing(time::nanoseconds(options_.startup_timeout),
                                       time::wall_time_now())),
      lab_({.name = name_,
            .domain_id = options_.lab_domain,
            .role = dds::DomainRole::kLab,
            .transport = options_.transport,
            .lease = options_.time.lease,
            .discovery_server = options_.discovery_server,
            .version = options_.version,
            .security = options_.security,
            .on_loss =
                [this](const std::string& line) { process::log(name_, machine::warning(line)); },
            .admits = [this](const auto& publisher,
                             std::size_t bytes) { return shell_.admits(publisher, bytes); },
            .on_published = options_.on_published},
           [this] { shell_.presence_changed(); }),
      ready_writer_(lab_, dds::topics::ready_status(), [this] { shell_.presence_changed(); }),
      request_writer_(lab_, dds::topics::parameter_request()),
      parameter_reader_(
          lab_, dds::topics::parameter(),
          [this](const Parameter& parameter) { shell_.post(parameter); }, {},
          dds::only_on_loopback<Parameter>(options_.transport, kLabControlName)),
      trigger_reader_(
          lab_, dds::topics::system_trigger(),
          [this](const SystemTrigger& trigger) {
            shell_.trigger(trigger.next_start);
            if (trigger.next_start == kStopSymbol) shell_.post_urgent(trigger);
          },
          [this] { shell_.presence_changed(); },
          dds::only_on_loopback<SystemTrigger>(options_.transport, kLabControlName)) {
  for (std::size_t i = 0; i < options_.vehicles.size(); ++i) {
    vehicles_.emplace(options_.vehicles[i].vehicle_id, std::make_unique<Vehicle>(*this, i));
  }
}

VehicleProcess::~VehicleProcess() = default;

int VehicleProcess::run() {
  for (const SimulatedVehicleOptions& vehicle : options_.vehicles) {
    const Pose& pose = vehicle.start;
    vehicles_.at(vehicle.vehicle_id)
        ->perform(machine::info(fmt::format("at ({:.3f} m, {:.3f} m, {:.3f} rad)", pose.x_m,
                                            pose.y_m, pose.heading_rad)));
  }
  const int exit_code = shell_.run(*this);
  bool are_complete = true;
  for (run_folder::DriveRecorder& recorder : recorders_) {
    if (const auto incomplete = recorder.close()) {
      perform(machine::warning(*incomplete));
      are_complete = false;
    }
  }
  return exit_code_with_outputs(exit_code, are_complete);
}

simulated_vehicle::FleetPresence VehicleProcess::presence() const {
  simulated_vehicle::FleetPresence presence;
  const machine::Participants lab{.alive = lab_.alive(), .lost = lab_.lost()};
  for (const auto& [id, vehicle] : vehicles_) {
    presence[id] = {
        .lab = lab,
        .state_readers = {vehicle->state.matched(), vehicle->state.matched_names()},
        .command_writers = {vehicle->trajectory->matched(), vehicle->trajectory->matched_names()},
        .ready_readers = ready_writer_.matched(),
        .trigger_writers = trigger_reader_.matched()};
  }
  return presence;
}

void VehicleProcess::perform(const OfVehicle<VehicleMachine::Action>& action) {
  Vehicle& vehicle = *vehicles_.at(action.vehicle_id);
  std::visit([&vehicle](const auto& what) { vehicle.perform(what); }, action.what);
}

}  // namespace hlc::apps
