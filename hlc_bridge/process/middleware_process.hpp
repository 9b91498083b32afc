#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hlc_bridge/dds/participant.hpp"
#include "hlc_bridge/dds/reader.hpp"
#include "hlc_bridge/dds/writer.hpp"
#include "hlc_bridge/messages/messages.hpp"
#include "hlc_bridge/messages/time_grid.hpp"
#include "hlc_bridge/middleware/middleware_machine.hpp"
#include "hlc_bridge/process/shell.hpp"

namespace hlc {

struct MiddlewareOptions {
  /// For the log, and in logical time the source_id of the timer's ready status (wire contract,
  /// 5.3). On the domains the process always bears its vehicle's name (messages/node_names).
  std::string node_id;
  std::string version{};                  ///< ParticipantOptions::version
  std::vector<std::uint8_t> vehicle_ids;  ///< of its controllers; at least one
  Transport transport{Transport::kLab};
  int lab_domain{};
  int local_domain{};
  std::optional<DiscoveryServer> discovery_server;
  bool logical_time{};
  Nanoseconds offset{kListOffset};  ///< of the lists in a period
  /// After the stop symbol wait for the next experiment instead of ending (real time).
  bool keep_running{};
  std::chrono::seconds startup_timeout{30};
};

/// Stands between controllers (local domain; one, or those of several vehicles) and the vehicles
/// (lab domain): the endpoints of a MiddlewareMachine, which says what it does and when it ends.
///
/// On the lab's transport, where controllers and vehicles of others may be: commands of all four
/// kinds, goals, and lists with the camera system's observations. On loopback: trajectories, which
/// is what ours sends.
///
/// One thread, that of `run`. What is forwarded (commands, the stop symbol) wakes it at once; it
/// waits for nothing else than the next event, so that no command waits for a list.
class MiddlewareProcess {
 public:
  /// @throws std::invalid_argument, std::runtime_error for options that cannot work
  explicit MiddlewareProcess(MiddlewareOptions options);
  ~MiddlewareProcess();

  /// Until the stop symbol has come (see keep_running), or `stop` is called. The exit code: 0 good,
  /// 2 if the lab control's parameters do not fit, 3 if somebody needed did not appear, 4 if the
  /// lab control is lost, or (logical time) sends no trigger any more.
  [[nodiscard]] int run() { return shell_.run(*this); }

  /// Ends `run` soon. From any thread.
  void stop() { shell_.stop(); }

 private:
  friend class Shell<MiddlewareMachine>;
  /// What goes out to one vehicle.
  struct Vehicle;
  /// What only the lab's programs say and hear: on its transport.
  struct LabEndpoints;

  // For the shell:
  void perform(const machine::LogLine& line) const;
  void perform(const SubscribeToVehicles& vehicles);
  void perform(const VehicleStateList& list) { list_writer_.write(list); }
  void perform(const SystemTrigger& trigger) { trigger_writer_.write(trigger); }
  void perform(const GoalState& goal);
  void perform(const VehicleCommand& command);
  void perform(const ReadyStatus& status) { ready_writer_.write(status); }
  void perform(const ParameterRequest& request) { request_writer_.write(request); }
  [[nodiscard]] MiddlewarePeers presence() const;

  void receive(const SystemTrigger& trigger);

  MiddlewareOptions options_;
  Shell<MiddlewareMachine> shell_;
  bool is_triggered_{};  ///< of the trigger reader's callback

  // Destroyed first: no callback comes afterwards.
  Participant lab_;
  Participant local_;
  Writer<VehicleStateList> list_writer_;
  Writer<SystemTrigger> trigger_writer_;
  std::map<std::uint8_t, std::unique_ptr<Vehicle>> vehicles_;  ///< of the controllers
  Writer<ReadyStatus> ready_writer_;
  Writer<ParameterRequest> request_writer_;
  Reader<Parameter> parameter_reader_;
  Reader<SystemTrigger> trigger_reader_;
  Reader<TrajectoryCommand> command_reader_;
  Reader<ReadyStatus> ready_reader_;
  std::map<std::uint8_t, Reader<VehicleState>> state_readers_;
  std::unique_ptr<LabEndpoints> lab_endpoints_;
};

}  // namespace hlc
