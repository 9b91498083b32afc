#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hlc_bridge/dds/participant.hpp"
#include "hlc_bridge/dds/reader.hpp"
#include "hlc_bridge/dds/writer.hpp"
#include "hlc_bridge/machine/pacing.hpp"
#include "hlc_bridge/messages/messages.hpp"
#include "hlc_bridge/messages/time_grid.hpp"
#include "hlc_bridge/middleware/middleware_machine.hpp"
#include "hlc_bridge/process/shell.hpp"

namespace hlc::process {

struct MiddlewareOptions {
  /// For the log, and in logical time the source_id of the timer's ready status (wire contract,
  /// 5.3). On the domains the process always has its vehicle's name (messages/node_names).
  std::string node_id;
  std::string version{};  ///< ParticipantOptions::version
  std::function<void(const dds::PublishedMessage&)> on_published{};  ///< ParticipantOptions
  std::vector<std::uint8_t> vehicle_ids;  ///< of its controllers; at least one
  dds::Transport transport{dds::Transport::kLab};
  int lab_domain{};
  int local_domain{};
  std::optional<dds::DiscoveryServer> discovery_server;
  std::filesystem::path security{};  ///< ParticipantOptions
  machine::RunTime time{machine::kRealTime};
  middleware::MiddlewareRules rules{middleware::real_middleware_rules(true)};
  Nanoseconds offset{kListOffset};  ///< of the lists in a period
  /// Waits for the next experiment after the stop symbol instead of ending (real time).
  bool keep_running{};
  std::chrono::seconds startup_timeout{30};
};

/// Connects controllers (local domain; one, or those of several vehicles) and vehicles (lab
/// domain): the endpoints of a MiddlewareMachine, which decides on all actions and on the end.
///
/// On the lab's transport, with controllers and vehicles of others: commands of all four kinds,
/// goals, and lists with the camera system's observations. On loopback: trajectories only, which is
/// what our controllers send.
///
/// One thread, that of `run`. Messages to be forwarded (commands, the stop symbol) wake it at once;
/// it waits only for the next event, so that no command waits for a list.
class MiddlewareProcess {
 public:
  /// @throws std::invalid_argument, std::runtime_error for options that cannot work
  explicit MiddlewareProcess(MiddlewareOptions options);
  ~MiddlewareProcess();

  /// Runs until the stop symbol (see keep_running) or `stop`. Exit code: 0 success, 2 if the lab
  /// control's parameters do not fit, 3 startup timeout, 4 if the lab control is lost, or (logical
  /// time) no longer sends triggers.
  [[nodiscard]] int run() { return shell_.run(*this); }

  /// Ends `run` soon. From any thread.
  void stop() { shell_.stop(); }

 private:
  friend class machine::Loop<middleware::MiddlewareMachine>;
  /// The endpoints for one vehicle.
  struct Vehicle;
  /// Endpoints for the lab's programs only: on its transport.
  struct LabEndpoints;
  /// What passes between this process and the lab control.
  struct LabControlEndpoints {
    explicit LabControlEndpoints(MiddlewareProcess& process);
    [[nodiscard]] bool are_matched() const { return ready.matched() > 0 && trigger.matched() > 0; }

    dds::Writer<ReadyStatus> ready;
    dds::Writer<ParameterRequest> request;
    dds::Reader<Parameter> parameter;
    dds::Reader<SystemTrigger> trigger;
  };
  /// What passes between this process and its controllers.
  struct ControllerEndpoints {
    explicit ControllerEndpoints(MiddlewareProcess& process);

    dds::Writer<VehicleStateList> list;
    dds::Writer<SystemTrigger> trigger;
    dds::Reader<TrajectoryCommand> command;
    dds::Reader<ReadyStatus> ready;
  };

  // For the shell:
  void perform(const machine::LogLine& line) const;
  void perform(const middleware::SubscribeToVehicles& vehicles);
  void perform(const VehicleStateList& list) { controllers_.list.write(list); }
  void perform(const SystemTrigger& trigger) { controllers_.trigger.write(trigger); }
  void perform(const GoalState& goal);
  void perform(const middleware::VehicleCommand& command);
  void perform(const ReadyStatus& status) { lab_control_.ready.write(status); }
  void announce_tick(const ReadyStatus& status) { perform(status); }
  void perform(const ParameterRequest& request) { lab_control_.request.write(request); }
  [[nodiscard]] middleware::MiddlewarePeers presence() const;

  void receive(const SystemTrigger& trigger);
  [[nodiscard]] std::function<void()> on_presence() {
    return [this] { shell_.presence_changed(); };
  }

  MiddlewareOptions options_;
  Shell<middleware::MiddlewareMachine> shell_;
  bool is_triggered_{};  ///< of the trigger reader's callback

  // Destroyed first: no callback comes afterwards.
  dds::Participant lab_;
  dds::Participant local_;
  LabControlEndpoints lab_control_;
  ControllerEndpoints controllers_;
  std::map<std::uint8_t, std::unique_ptr<Vehicle>> vehicles_;  ///< of the controllers
  std::map<std::uint8_t, dds::Reader<VehicleState>> state_readers_;
  std::unique_ptr<LabEndpoints> lab_endpoints_;
};

}  // namespace hlc::process
