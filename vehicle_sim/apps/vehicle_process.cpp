#include "vehicle_sim/apps/vehicle_process.hpp"

#include <fmt/format.h>

#include <utility>

#include "hlc_bridge/messages/node_names.hpp"
#include "hlc_bridge/messages/time_grid.hpp"

namespace hlc::apps {
namespace {

simulated_vehicle::VehicleMachineOptions machine_options(const VehicleProcessOptions& options) {
  return {.vehicle = options.vehicle,
          .rules = options.rules,
          .is_among_lab_programs = options.transport == dds::Transport::kLab,
          .keep_running = options.keep_running,
          .ticks_by_period = options.ticks_by_period,
          .startup_timeout = time::nanoseconds(options.startup_timeout)};
}

}  // namespace

struct VehicleProcess::LabEndpoints {
  explicit LabEndpoints(VehicleProcess& process)
      : observation_writer{process.lab_,
                           dds::topics::vehicle_observation(process.options_.vehicle.vehicle_id)},
        path_tracking_reader{reader<PathTrackingCommand>(process)},
        speed_curvature_reader{reader<SpeedCurvatureCommand>(process)},
        direct_reader{reader<DirectCommand>(process)} {}

  template <class Received>
  static dds::Reader<Received> reader(VehicleProcess& process) {
    return dds::Reader<Received>{
        process.lab_, dds::topics::vehicle_command<Received>(process.options_.vehicle.vehicle_id),
        [&process](const Received& command) { process.shell_.post(command); }};
  }

  dds::Writer<VehicleObservation> observation_writer;
  dds::Reader<PathTrackingCommand> path_tracking_reader;
  dds::Reader<SpeedCurvatureCommand> speed_curvature_reader;
  dds::Reader<DirectCommand> direct_reader;
};

VehicleProcess::VehicleProcess(VehicleProcessOptions options)
    : options_(std::move(options)),
      name_(vehicle_name(options_.vehicle.vehicle_id)),
      recorder_(options_.record_file.empty()
                    ? std::nullopt
                    : std::optional<DriveRecorder>(std::in_place, options_.record_file,
                                                   options_.append_record)),
      shell_(name_, simulated_vehicle::VehicleMachine(machine_options(options_)),
             options_.time.make_pacing(time::nanoseconds(options_.startup_timeout),
                                       time::wall_time_now())),
      lab_({.name = name_,
            .domain_id = options_.lab_domain,
            .role = dds::DomainRole::kLab,
            .transport = options_.transport,
            .lease = options_.time.lease,
            .discovery_server = options_.discovery_server,
            .version = options_.version,
            .on_loss =
                [this](const std::string& line) { process::log(name_, machine::warning(line)); }},
           [this] { shell_.presence_changed(); }),
      state_writer_(lab_, dds::topics::vehicle_state(options_.vehicle.vehicle_id),
                    [this] { shell_.presence_changed(); }),
      ready_writer_(lab_, dds::topics::ready_status(), [this] { shell_.presence_changed(); }),
      request_writer_(lab_, dds::topics::parameter_request()),
      command_reader_(
          lab_, dds::topics::vehicle_command(options_.vehicle.vehicle_id),
          [this](const TrajectoryCommand& command) { shell_.post(command); },
          [this] { shell_.presence_changed(); }),
      parameter_reader_(lab_, dds::topics::parameter(),
                        [this](const Parameter& parameter) { shell_.post(parameter); }),
      trigger_reader_(
          lab_, dds::topics::system_trigger(),
          [this](const SystemTrigger& trigger) {
            shell_.trigger(trigger.next_start);
            if (trigger.next_start == kStopSymbol) shell_.post_urgent(trigger);
          },
          [this] { shell_.presence_changed(); }) {
  if (options_.transport == dds::Transport::kLab) {
    lab_endpoints_ = std::make_unique<LabEndpoints>(*this);
  }
}

VehicleProcess::~VehicleProcess() = default;

int VehicleProcess::run() {
  const Pose& pose = options_.vehicle.start;
  perform(machine::info(
      fmt::format("at ({:.3f} m, {:.3f} m, {:.3f} rad)", pose.x_m, pose.y_m, pose.heading_rad)));
  return shell_.run(*this);
}

simulated_vehicle::VehiclePresence VehicleProcess::presence() const {
  return {.lab = {.alive = lab_.alive(), .lost = lab_.lost()},
          .state_readers = {state_writer_.matched(), state_writer_.matched_names()},
          .command_writers = {command_reader_.matched(), command_reader_.matched_names()},
          .ready_readers = ready_writer_.matched(),
          .trigger_writers = trigger_reader_.matched()};
}

void VehicleProcess::perform(const VehicleObservation& observation) {
  if (lab_endpoints_) lab_endpoints_->observation_writer.write(observation);
}

void VehicleProcess::perform(const result::DrivenSample& sample) {
  if (recorder_) recorder_->write(sample);
}

}  // namespace hlc::apps
