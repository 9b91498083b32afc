#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>

#include "hlc_bridge/dds/participant.hpp"
#include "hlc_bridge/dds/reader.hpp"
#include "hlc_bridge/dds/writer.hpp"
#include "hlc_bridge/machine/pacing.hpp"
#include "hlc_bridge/process/log.hpp"
#include "hlc_bridge/process/shell.hpp"
#include "vehicle_sim/apps/drive_recorder.hpp"
#include "vehicle_sim/vehicle/vehicle_machine.hpp"

namespace hlc::apps {

struct VehicleProcessOptions {
  simulated_vehicle::SimulatedVehicleOptions vehicle;
  std::string version{};  ///< ParticipantOptions::version
  dds::Transport transport{dds::Transport::kLab};
  int lab_domain{};
  std::optional<dds::DiscoveryServer> discovery_server;
  machine::RunTime time{machine::kRealTime};
  machine::PacingRules rules{machine::real_rules(kVehicleStays)};
  bool keep_running{};  ///< VehicleMachineOptions
  bool ticks_by_period{};  ///< the same
  std::chrono::seconds startup_timeout{30};
  std::string record_file;  ///< empty: no record
  bool append_record{};     ///< DriveRecorder
};

/// One simulated vehicle on the lab domain: the endpoints and the record of a VehicleMachine. In
/// real time it publishes its states without waiting, in logical time it waits for all
/// participants.
class VehicleProcess {
 public:
  /// @throws std::invalid_argument, std::runtime_error for options that cannot work
  explicit VehicleProcess(VehicleProcessOptions options);
  ~VehicleProcess();

  /// Until the stop symbol was received and the vehicle has braked, or `stop` is called. The exit
  /// code: also 3 if a required participant did not appear, and 4 if the lab control dies.
  [[nodiscard]] int run();

  /// Ends the run soon. From any thread.
  void stop() { shell_.stop(); }

 private:
  friend class machine::Loop<simulated_vehicle::VehicleMachine>;
  /// Endpoints for messages that only the lab's programs send and receive: on the lab's transport.
  struct LabEndpoints;

  [[nodiscard]] simulated_vehicle::VehiclePresence presence() const;
  void perform(const ParameterRequest& request) { request_writer_.write(request); }
  void announce_tick(const ReadyStatus& status) { ready_writer_.write(status); }
  void perform(const VehicleState& state) { state_writer_.write(state); }
  void perform(const VehicleObservation& observation);
  void perform(const result::DrivenSample& sample);
  void perform(const machine::LogLine& line) { process::log(name_, line); }

  VehicleProcessOptions options_;
  std::string name_;
  std::optional<DriveRecorder> recorder_;
  process::Shell<simulated_vehicle::VehicleMachine> shell_;

  // Readers last: they are destroyed first, and no callback is called after that.
  dds::Participant lab_;
  dds::Writer<VehicleState> state_writer_;
  dds::Writer<ReadyStatus> ready_writer_;
  dds::Writer<ParameterRequest> request_writer_;
  dds::Reader<TrajectoryCommand> command_reader_;
  dds::Reader<Parameter> parameter_reader_;
  dds::Reader<SystemTrigger> trigger_reader_;
  std::unique_ptr<LabEndpoints> lab_endpoints_;
};

}  // namespace hlc::apps
