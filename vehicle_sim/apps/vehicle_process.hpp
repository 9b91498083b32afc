#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "hlc_bridge/dds/participant.hpp"
#include "hlc_bridge/dds/reader.hpp"
#include "hlc_bridge/dds/writer.hpp"
#include "hlc_bridge/messages/exit_codes.hpp"
#include "hlc_bridge/messages/messages.hpp"
#include "hlc_bridge/messages/run_parameters.hpp"
#include "hlc_bridge/time/logical_timer.hpp"
#include "hlc_bridge/time/real_timer.hpp"
#include "hlc_bridge/time/signal.hpp"
#include "hlc_bridge/time/wait_notice.hpp"
#include "vehicle_sim/apps/drive_recorder.hpp"
#include "vehicle_sim/vehicle/simulated_vehicle.hpp"

namespace hlc {

struct VehicleProcessOptions {
  SimulatedVehicleOptions vehicle;
  std::string version{};  ///< ParticipantOptions::version
  Transport transport{Transport::kLab};
  int lab_domain{};
  std::optional<DiscoveryServer> discovery_server;
  bool logical_time{};
  bool keep_running{};  ///< after a stop brake, then listen again instead of ending
  std::chrono::seconds startup_timeout{30};
  std::string record_file;  ///< empty: no record
  bool append_record{};     ///< DriveRecorder
};

/// One simulated vehicle on the lab domain: every 20 ms it takes the commands that have come, makes
/// one step of `SimulatedVehicle` and publishes its state.
///
/// Real time: ticks by the clock, whoever is there. A tick that the process was too late for is
/// made up for (the plant must keep up with the clock) but its state is not published.
///
/// Logical time: before its first tick it learns period and active vehicles from the lab control
/// and has all its endpoints matched, so that nothing said in the run is lost. Each tick waits for
/// the answer to the last list before it; that wait ends when the middleware or the controller is
/// lost, or after 10 s (then nobody waits for them until a command is heard again).
class VehicleProcess {
 public:
  /// @throws std::invalid_argument, std::runtime_error for options that cannot work
  explicit VehicleProcess(VehicleProcessOptions options);
  ~VehicleProcess();

  /// Until the stop symbol has come and the vehicle has braked, or `stop` is called. The exit code:
  /// also 3 if somebody needed did not appear, and 4 if the lab control dies.
  [[nodiscard]] int run();

  /// Ends the run soon. From any thread.
  void stop();

 private:
  using Command =
      std::variant<TrajectoryCommand, PathTrackingCommand, SpeedCurvatureCommand, DirectCommand>;
  /// What only the lab's programs say and hear: on its transport.
  struct LabEndpoints;

  // Under the signal's lock:
  [[nodiscard]] bool is_ending() const { return stop_ || stop_symbol_; }
  [[nodiscard]] bool is_connected() const;
  [[nodiscard]] bool wait_for_everybody(std::chrono::steady_clock::time_point deadline);
  [[nodiscard]] bool is_answered(Nanoseconds list) const;

  template <class Received>
  void take(const Received& command);

  [[nodiscard]] bool is_ending_now() const {
    return signal_.locked([this] { return is_ending(); });
  }
  std::unique_ptr<Timer> make_timer();
  /// Logical time: waits for all that has to be there before the first tick. An exit code.
  [[nodiscard]] int prepare();
  [[nodiscard]] bool learn_parameters(std::chrono::steady_clock::time_point deadline);
  [[nodiscard]] std::string who_is_missing() const;
  /// Tells the lab control that everything before `next_tick` is done; ends the timer if it is
  /// gone.
  void send_ready(Nanoseconds next_tick);
  void watch_lab_control(Nanoseconds t_now);

  /// True if the run goes on after this tick.
  [[nodiscard]] bool tick(Nanoseconds t_now);
  void wait_for_answer(Nanoseconds t_now);
  void make_up_for_missed_ticks(Nanoseconds t_now);
  SimulatedVehicle::Tick step(Nanoseconds t_now);
  void tell_why_it_stops(const SimulatedVehicle::Tick& done);

  VehicleProcessOptions options_;
  std::string name_;
  std::string middleware_;  ///< names of those who answer
  std::string controller_;
  SimulatedVehicle vehicle_;
  std::optional<DriveRecorder> recorder_;
  std::optional<Nanoseconds> last_tick_;
  FollowerStatus last_status_{FollowerStatus::kNoCommand};
  bool is_stopping_{};  ///< the stop symbol has come, and the vehicle brakes
  WaitNotice wait_notice_;
  bool lab_control_lost_{};
  std::optional<Nanoseconds> lab_control_lost_at_;  ///< real time

  Signal signal_;
  // Guarded by the signal:
  std::vector<Command> inbox_;
  Nanoseconds newest_answer_{};  ///< largest create_stamp heard
  bool gave_up_waiting_{};
  bool stop_{};
  bool stop_symbol_{};
  RunParameters parameters_;

  LogicalTimer* logical_timer_{};  ///< timer_, if time is logical
  std::unique_ptr<Timer> timer_;

  // Readers last: they are destroyed first, and no callback comes after that.
  Participant lab_;
  Writer<VehicleState> state_writer_;
  Writer<ReadyStatus> ready_writer_;
  Writer<ParameterRequest> request_writer_;
  Reader<TrajectoryCommand> command_reader_;
  Reader<Parameter> parameter_reader_;
  Reader<SystemTrigger> trigger_reader_;
  std::unique_ptr<LabEndpoints> lab_endpoints_;
};

}  // namespace hlc
