#include "hlc_bridge/process/middleware_process.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <utility>

#include "hlc_bridge/dds/topics.hpp"
#include "hlc_bridge/machine/pacing.hpp"
#include "hlc_bridge/messages/node_names.hpp"
#include "hlc_bridge/process/log.hpp"

namespace hlc::process {
namespace {

middleware::MiddlewareSettings settings_of(const MiddlewareOptions& options) {
  return {.vehicle_ids = options.vehicle_ids,
          .offset = options.offset,
          .keep_running = options.keep_running,
          .startup_timeout = time::nanoseconds(options.startup_timeout),
          .rules = options.rules};
}

dds::ParticipantOptions on_domain(const MiddlewareOptions& options, dds::DomainRole role,
                                  Shell<middleware::MiddlewareMachine>& shell) {
  const bool lab = role == dds::DomainRole::kLab;
  return {
      .name = middleware_name(options.vehicle_ids),
      .domain_id = lab ? options.lab_domain : options.local_domain,
      .role = role,
      .transport = options.transport,
      .lease = options.time.lease,
      .discovery_server = lab ? options.discovery_server : std::nullopt,
      .version = options.version,
      .security = options.security,
      .on_loss = [id = options.node_id](
                     const std::string& line) { spdlog::warn(fmt::format("{}: {}", id, line)); },
      .admits = [&shell](const auto& publisher,
                         std::size_t bytes) { return shell.admits(publisher, bytes); },
      .on_published = options.on_published};
}

}  // namespace

struct MiddlewareProcess::Vehicle {
  Vehicle(MiddlewareProcess& process, std::uint8_t id)
      : trajectory{process.lab_, dds::topics::vehicle_command(id), process.on_presence()} {
    if (process.options_.transport == dds::Transport::kLab) {
      path_tracking.emplace(process.lab_, dds::topics::vehicle_command<PathTrackingCommand>(id));
      speed_curvature.emplace(process.lab_,
                              dds::topics::vehicle_command<SpeedCurvatureCommand>(id));
      direct.emplace(process.lab_, dds::topics::vehicle_command<DirectCommand>(id));
    }
  }

  void write(const TrajectoryCommand& command) { trajectory.write(command); }
  void write(const PathTrackingCommand& command) { path_tracking->write(command); }
  void write(const SpeedCurvatureCommand& command) { speed_curvature->write(command); }
  void write(const DirectCommand& command) { direct->write(command); }

  dds::Writer<TrajectoryCommand> trajectory;
  std::optional<dds::Writer<PathTrackingCommand>> path_tracking;
  std::optional<dds::Writer<SpeedCurvatureCommand>> speed_curvature;
  std::optional<dds::Writer<DirectCommand>> direct;
};

struct MiddlewareProcess::LabEndpoints {
  explicit LabEndpoints(MiddlewareProcess& process)
      : path_tracking{reader<PathTrackingCommand>(process)},
        speed_curvature{reader<SpeedCurvatureCommand>(process)},
        direct{reader<DirectCommand>(process)},
        goal_writer{process.local_, dds::topics::goal_state()},
        goal_reader{process.lab_, dds::topics::goal_state(),
                    [&process](const GoalState& goal) { process.shell_.post(goal); }} {}

  template <class Command>
  static dds::Reader<Command> reader(MiddlewareProcess& process) {
    return dds::Reader<Command>{process.local_, dds::topics::command<Command>(),
                                [&process](const Command& command) {
                                  process.shell_.post_urgent(middleware::VehicleCommand{command});
                                },
                                process.on_presence(), dds::kItsController};
  }

  [[nodiscard]] bool commands_are_sent() const {
    return path_tracking.matched() > 0 || speed_curvature.matched() > 0 || direct.matched() > 0;
  }

  dds::Reader<PathTrackingCommand> path_tracking;
  dds::Reader<SpeedCurvatureCommand> speed_curvature;
  dds::Reader<DirectCommand> direct;
  dds::Writer<GoalState> goal_writer;
  dds::Reader<GoalState> goal_reader;
  std::map<std::uint8_t, dds::Reader<VehicleObservation>> observations;
};

MiddlewareProcess::LabControlEndpoints::LabControlEndpoints(MiddlewareProcess& process)
    : ready(process.lab_, dds::topics::ready_status(), process.on_presence()),
      request(process.lab_, dds::topics::parameter_request()),
      parameter(
          process.lab_, dds::topics::parameter(),
          [&process](const Parameter& one) { process.shell_.post(one); }, {},
          dds::only_on_loopback<Parameter>(process.options_.transport, kLabControlName)),
      trigger(
          process.lab_, dds::topics::system_trigger(),
          [&process](const SystemTrigger& one) { process.receive(one); }, process.on_presence(),
          dds::only_on_loopback<SystemTrigger>(process.options_.transport, kLabControlName)) {}

MiddlewareProcess::ControllerEndpoints::ControllerEndpoints(MiddlewareProcess& process)
    : list(process.local_, dds::topics::vehicle_state_list(), process.on_presence()),
      trigger(process.local_, dds::topics::system_trigger(), process.on_presence()),
      command(
          process.local_, dds::topics::command(),
          [&process](const TrajectoryCommand& one) {
            process.shell_.post_urgent(middleware::VehicleCommand{one});
          },
          process.on_presence(), dds::kItsController),
      ready(
          process.local_, dds::topics::ready_status(),
          [&process](const ReadyStatus& status) { process.shell_.post(status); },
          process.on_presence()) {}

MiddlewareProcess::MiddlewareProcess(MiddlewareOptions options)
    : options_(std::move(options)),
      shell_(options_.node_id, middleware::MiddlewareMachine{settings_of(options_)},
             options_.time.make_pacing(time::nanoseconds(options_.startup_timeout),
                                       time::wall_time_now())),
      lab_(on_domain(options_, dds::DomainRole::kLab, shell_), on_presence()),
      local_(on_domain(options_, dds::DomainRole::kLocal, shell_), on_presence()),
      lab_control_(*this),
      controllers_(*this) {
  for (const std::uint8_t id : options_.vehicle_ids) {
    vehicles_.emplace(id, std::make_unique<Vehicle>(*this, id));
  }
  if (options_.transport == dds::Transport::kLab) {
    lab_endpoints_ = std::make_unique<LabEndpoints>(*this);
  }
}

MiddlewareProcess::~MiddlewareProcess() = default;

/// On a DDS thread. A trigger to be forwarded arrives before the tick that it releases; the others,
/// 50 a second, do not wake the thread: that would slow down a run in logical time.
void MiddlewareProcess::receive(const SystemTrigger& trigger) {
  const bool is_first = !std::exchange(is_triggered_, true);
  if (is_first || trigger.next_start == kStopSymbol || options_.transport == dds::Transport::kLab) {
    shell_.post_urgent(trigger);
  } else {
    shell_.post(trigger);
  }
  shell_.trigger(trigger.next_start);
}

void MiddlewareProcess::perform(const machine::LogLine& line) const { log(options_.node_id, line); }

void MiddlewareProcess::perform(const middleware::SubscribeToVehicles& vehicles) {
  for (const std::int32_t active : vehicles.vehicle_ids) {
    const auto id = static_cast<std::uint8_t>(active);
    state_readers_.try_emplace(
        id, lab_, dds::topics::vehicle_state(id),
        [this, id](const VehicleState& state) {
          shell_.post(middleware::PublishedState{.vehicle_id = id, .state = state});
        },
        on_presence(), dds::only(vehicle_name(id)));
    if (lab_endpoints_) {
      lab_endpoints_->observations.try_emplace(id, lab_, dds::topics::vehicle_observation(id),
                                               [this, id](const VehicleObservation& observation) {
                                                 shell_.post(middleware::PublishedObservation{
                                                     .vehicle_id = id, .observation = observation});
                                               });
    }
  }
}

void MiddlewareProcess::perform(const GoalState& goal) { lab_endpoints_->goal_writer.write(goal); }

void MiddlewareProcess::perform(const middleware::VehicleCommand& command) {
  Vehicle& vehicle = *vehicles_.at(middleware::vehicle_of(command));
  std::visit([&vehicle](const auto& any) { vehicle.write(any); }, command);
}

middleware::MiddlewarePeers MiddlewareProcess::presence() const {
  middleware::MiddlewarePeers peers;
  peers.lab_control_is_matched = lab_control_.are_matched();
  peers.lab_control_is_lost = lab_.is_lost(kLabControlName);
  peers.commands_are_sent =
      controllers_.command.matched() > 0 || (lab_endpoints_ && lab_endpoints_->commands_are_sent());
  // One of the lab's controllers may drive several vehicles.
  const std::size_t all =
      options_.transport == dds::Transport::kLoopback ? options_.vehicle_ids.size() : 1;
  peers.controllers_are_matched =
      controllers_.list.matched() >= all && controllers_.trigger.matched() >= all &&
      peers.commands_are_sent && controllers_.command.matched() >= all &&
      controllers_.ready.matched() >= all;
  for (const auto& [id, reader] : state_readers_) {
    if (reader.matched() > 0) peers.state_publishers.insert(id);
  }
  for (const auto& [id, vehicle] : vehicles_) {
    if (vehicle->trajectory.matched() > 0) peers.command_subscribers.insert(id);
    if (local_.is_alive(controller_name(id))) peers.own_controllers.insert(id);
    if (local_.is_lost(controller_name(id))) peers.lost_controllers.insert(id);
  }
  return peers;
}

}  // namespace hlc::process
