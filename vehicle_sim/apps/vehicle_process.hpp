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
#include "hlc_bridge/process/log.hpp"
#include "hlc_bridge/process/shell.hpp"
#include "vehicle_sim/run_folder/drive_recorder.hpp"
#include "vehicle_sim/vehicle/vehicle_fleet.hpp"

namespace hlc::apps {

struct VehicleProcessOptions {
  std::vector<simulated_vehicle::SimulatedVehicleOptions> vehicles;  ///< at least one
  std::vector<std::uint8_t> guest_ids{};                             ///< VehicleMachineOptions
  std::string version{};  ///< ParticipantOptions::version
  std::function<void(const dds::PublishedMessage&)> on_published{};  ///< ParticipantOptions
  dds::Transport transport{dds::Transport::kLab};
  int lab_domain{};
  std::optional<dds::DiscoveryServer> discovery_server;
  std::filesystem::path security{};  ///< ParticipantOptions
  machine::RunTime time{machine::kRealTime};
  machine::PacingRules rules{machine::real_rules(kVehicleStays)};
  bool keep_running{};     ///< VehicleMachineOptions
  bool ticks_by_period{};  ///< the same
  std::chrono::seconds startup_timeout{30};
  std::vector<std::string> record_files;  ///< in the order of the vehicles; empty: no records
  bool append_record{};                   ///< run_folder::DriveRecorder
};

/// Simulated vehicles on the lab domain: the endpoints and the records of a VehicleFleet. In real
/// time they publish their states without waiting, in logical time they wait for all participants.
class VehicleProcess {
 public:
  /// @throws std::invalid_argument, std::runtime_error for options that cannot work
  explicit VehicleProcess(VehicleProcessOptions options);
  ~VehicleProcess();

  /// Until the stop symbol was received and the vehicles have braked, or `stop` is called. The exit
  /// code: also 1 if a record is incomplete, 3 if a required participant did not appear, and 4 if
  /// the lab control dies.
  [[nodiscard]] int run();

  /// Ends the run soon. From any thread.
  void stop() { shell_.stop(); }

 private:
  friend class machine::Loop<simulated_vehicle::VehicleFleet>;
  /// What belongs to one vehicle: its endpoints and its record.
  struct Vehicle;

  [[nodiscard]] simulated_vehicle::FleetPresence presence() const;
  void perform(const ParameterRequest& request) { request_writer_.write(request); }
  void announce_tick(const ReadyStatus& status) { ready_writer_.write(status); }
  void perform(
      const simulated_vehicle::OfVehicle<simulated_vehicle::VehicleMachine::Action>& action);
  void perform(const machine::LogLine& line) const { process::log(name_, line); }

  VehicleProcessOptions options_;
  std::string name_;
  std::vector<run_folder::DriveRecorder> recorders_;
  process::Shell<simulated_vehicle::VehicleFleet> shell_;

  // Readers last: they are destroyed first, and no callback is called after that.
  dds::Participant lab_;
  dds::Writer<ReadyStatus> ready_writer_;
  dds::Writer<ParameterRequest> request_writer_;
  std::map<std::uint8_t, std::unique_ptr<Vehicle>> vehicles_;
  dds::Reader<Parameter> parameter_reader_;
  dds::Reader<SystemTrigger> trigger_reader_;
};

}  // namespace hlc::apps
