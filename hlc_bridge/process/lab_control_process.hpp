#pragma once

#include <atomic>
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
#include "hlc_bridge/lab_control/lab_control_machine.hpp"
#include "hlc_bridge/lab_control/real_time_run.hpp"
#include "hlc_bridge/machine/pacing.hpp"
#include "hlc_bridge/process/log.hpp"
#include "hlc_bridge/process/progress_line.hpp"
#include "hlc_bridge/process/shell.hpp"
#include "hlc_bridge/record/report_file.hpp"

namespace hlc {

struct LabControlOptions {
  LabRunSettings run;
  std::string version{};  ///< ParticipantOptions::version
  Transport transport{Transport::kLab};
  int lab_domain{};
  int controller_domain{};
  std::optional<DiscoveryServer> discovery_server;
  std::vector<std::string>
      controller_peers;  ///< ParticipantOptions::peers of the controllers' domain
  RunTime time{kRealTime};
  std::unique_ptr<LabRun> (*make_run)(LabRunSettings){make_lab_run<RealTimeRun>};
  std::filesystem::path out;  ///< run folder; empty: nothing is recorded
  bool is_terminal{};         ///< standard error is one
};

/// The lab control as a process: the endpoints, the run folder and the operator's terminal of a
/// LabControlMachine. It is the master of logical time and records the controllers' reports.
class LabControlProcess {
 public:
  /// @throws std::invalid_argument, std::runtime_error for options that cannot work
  explicit LabControlProcess(LabControlOptions options);

  /// One run, from gathering to the end. The exit code (LabRunResult).
  [[nodiscard]] int run();

  /// Ends the run soon, with the stop symbol. From any thread.
  void interrupt() { shell_.stop(); }

 private:
  friend class Shell<LabControlMachine>;

  struct Writers {
    Writers(Participant& lab, Participant& controllers, std::function<void()> on_presence);

    Writer<SystemTrigger> trigger;
    Writer<Parameter> parameter;
    Writer<Log> log;
    Writer<RunState> run_state;
  };

  void listen_to_vehicles();
  [[nodiscard]] LabControlPresence presence() const;
  void perform(const Parameter& parameter) { writers_.parameter.write(parameter); }
  void perform(const ReportRecord& record);
  void perform(Log log);
  void perform(const RunState& state);
  void perform(const SystemTrigger& trigger) { writers_.trigger.write(trigger); }
  void perform(const ProgressText& progress) { progress_.show(progress.text); }
  void perform(const machine::LogLine& line);
  void log_result();
  void record_facts() const;

  LabControlOptions options_;
  std::optional<ReportFile> reports_;
  ProgressLine progress_;
  std::atomic<bool> is_gathering_{true};
  Shell<LabControlMachine> shell_;

  // Destroyed first: no callback comes afterwards.
  Participant lab_;
  Participant controllers_;
  Writers writers_;
  Reader<ReadyStatus> ready_reader_;
  Reader<ParameterRequest> request_reader_;
  Reader<StopRequest> stop_reader_;
  Reader<ReportRecord> report_reader_;
  std::map<std::uint8_t, Reader<VehicleState>> state_readers_;  ///< real time only
};

}  // namespace hlc
