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
#include "hlc_bridge/record/certificate_file.hpp"
#include "hlc_bridge/record/report_file.hpp"

namespace hlc::process {

struct LabControlOptions {
  lab_control::LabRunSettings run;
  std::string version{};  ///< ParticipantOptions::version
  std::function<void(const dds::PublishedMessage&)> on_published{};  ///< ParticipantOptions
  dds::Transport transport{dds::Transport::kLab};
  int lab_domain{};
  int controller_domain{};
  std::optional<dds::DiscoveryServer> discovery_server;
  std::filesystem::path security{};  ///< ParticipantOptions
  /// ParticipantOptions::peers of the controllers' domain
  std::vector<std::string> controller_peers;
  machine::RunTime time{machine::kRealTime};
  std::unique_ptr<lab_control::LabRun> (*make_run)(lab_control::LabRunSettings){
      lab_control::make_lab_run<lab_control::RealTimeRun>};
  std::filesystem::path out;  ///< run folder; empty: nothing is recorded
  bool is_terminal{};         ///< standard error is one
};

/// The lab control as a process: the endpoints, the run folder and the operator's terminal of a
/// LabControlMachine. It is the master of logical time and records the controllers' reports.
class LabControlProcess {
 public:
  /// @throws std::invalid_argument, std::runtime_error for options that cannot work
  explicit LabControlProcess(LabControlOptions options);

  /// One run, from gathering to the end. The exit code (LabRunResult; kExitNotWritten after success
  /// if a file of the run folder is incomplete).
  [[nodiscard]] int run();

  /// Ends the run soon, with the stop symbol. From any thread.
  void interrupt() { shell_.stop(); }

 private:
  friend class machine::Loop<lab_control::LabControlMachine>;

  struct Writers {
    Writers(dds::Participant& lab, dds::Participant& controllers,
            std::function<void()> on_presence);

    dds::Writer<SystemTrigger> trigger;
    dds::Writer<Parameter> parameter;
    dds::Writer<Log> log;
    dds::Writer<RunState> run_state;
  };

  void listen_to_vehicles();
  [[nodiscard]] lab_control::LabControlPresence presence() const;
  void perform(const Parameter& parameter) { writers_.parameter.write(parameter); }
  void perform(const ReportRecord& record);
  void perform(Log log);
  void perform(const RunState& state);
  void perform(const SystemTrigger& trigger) { writers_.trigger.write(trigger); }
  void perform(const lab_control::ProgressText& progress) { progress_.show(progress.text); }
  void perform(const machine::LogLine& line);
  /// False: one of them is incomplete, which is logged.
  [[nodiscard]] bool complete_records();
  void log_result();
  /// @throws std::runtime_error naming the file
  void record_facts() const;

  LabControlOptions options_;
  std::optional<record::ReportFile> reports_;
  std::optional<record::CertificateFile> certificates_;
  ProgressLine progress_;
  std::atomic<bool> is_gathering_{true};
  Shell<lab_control::LabControlMachine> shell_;

  // Destroyed first: no callback comes afterwards.
  dds::Participant lab_;
  dds::Participant controllers_;
  Writers writers_;
  dds::Reader<ReadyStatus> ready_reader_;
  dds::Reader<ParameterRequest> request_reader_;
  dds::Reader<StopRequest> stop_reader_;
  dds::Reader<ReportRecord> report_reader_;
  std::map<std::uint8_t, dds::Reader<VehicleState>> state_readers_;  ///< real time only
};

}  // namespace hlc::process
