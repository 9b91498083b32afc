#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include "hlc_bridge/dds/participant.hpp"
#include "hlc_bridge/dds/reader.hpp"
#include "hlc_bridge/dds/writer.hpp"
#include "hlc_bridge/lab_control/lab_run.hpp"
#include "hlc_bridge/process/progress_line.hpp"
#include "hlc_bridge/record/report_file.hpp"
#include "hlc_bridge/time/signal.hpp"

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
  bool logical_time{};
  std::filesystem::path out;  ///< run folder; empty: nothing is recorded
  bool is_terminal{};         ///< standard error is one
};

/// The part of the lab control centre that a run needs: answers the parameter requests, starts the
/// run, is the master of logical time, notices who dies, stops, and records the controllers'
/// reports.
///
/// One thread does everything: DDS callbacks only queue. What happens when is said by LabRun; this
/// class feeds it and does what it says.
class LabControlProcess {
 public:
  /// @throws std::invalid_argument, std::runtime_error for options that cannot work
  explicit LabControlProcess(LabControlOptions options);

  /// One run, from gathering to the end. The exit code (LabRunResult).
  [[nodiscard]] int run();

  /// Ends the run soon, with the stop symbol. From any thread.
  void interrupt();

 private:
  using Mail = std::variant<ReadyStatus, ReportRecord, VehicleState, StopRequest, ParameterRequest>;

  void listen_to_vehicles();
  [[nodiscard]] Nanoseconds now() const;
  void wait_for_mail();
  void read_mail();
  void read(const ReadyStatus& status) { run_->ready(status); }
  void read(const ReportRecord& record);
  void read(const VehicleState& state) { run_->state(state); }
  void read(const StopRequest& request) { run_->stop_requested(request.vehicle_id); }
  void read(const ParameterRequest& request);
  void look_who_is_there();
  void perform(const LabRunActions& actions);
  void show_progress();
  void let_everybody_leave() const;
  void tell_result();
  void record_facts() const;

  LabControlOptions options_;
  std::unique_ptr<LabRun> run_;
  std::optional<ReportFile> reports_;
  ProgressLine progress_;
  Nanoseconds began_{};  ///< wall time of the first trigger
  Nanoseconds start_{};  ///< real time: next_start of that trigger

  Signal signal_;  // guards what follows, down to the next blank line
  std::vector<Mail> mail_;
  bool presence_changed_{true};
  bool is_gathering_{true};
  bool interrupted_{};

  // Destroyed first: no callback comes afterwards.
  Participant lab_;
  Participant controllers_;
  Writer<SystemTrigger> trigger_writer_;
  Writer<Parameter> parameter_writer_;
  Writer<Log> log_writer_;
  Writer<RunState> run_state_writer_;
  Reader<ReadyStatus> ready_reader_;
  Reader<ParameterRequest> request_reader_;
  Reader<StopRequest> stop_reader_;
  Reader<ReportRecord> report_reader_;
  std::map<std::uint8_t, Reader<VehicleState>> state_readers_;  ///< real time only
};

}  // namespace hlc
