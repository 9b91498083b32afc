#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "hlc_bridge/lab_control/logical_run.hpp"
#include "hlc_bridge/lab_control/real_time_run.hpp"
#include "hlc_bridge/messages/run_parameters.hpp"
#include "vehicle_sim/closed_loop/host.hpp"

namespace hlc::closed_loop {

/// Who is on the lab's and the controllers' domain, and whom triggers reach.
struct LabPresence {
  std::set<std::string> alive;
  std::set<std::string> lost;
  std::set<std::string> trigger_readers;
};

/// The lab control's process as a machine around LabRun.
class LabControlMachine {
 public:
  using Event = std::variant<machine::StopSignal, LabPresence, ReadyStatus, ReportRecord,
                             VehicleState, StopRequest, ParameterRequest>;
  using Action = std::variant<machine::LogLine, RunState, SystemTrigger, Parameter>;

  static constexpr Nanoseconds kLeaveTime = 800 * kNanosecondsPerMillisecond;

  LabControlMachine(LabRunSettings settings, bool is_logical)
      : settings_(settings), is_logical_(is_logical) {
    if (is_logical) {
      run_ = std::make_unique<LogicalRun>(std::move(settings));
    } else {
      run_ = std::make_unique<RealTimeRun>(std::move(settings));
    }
  }

  void on(Event event) {
    std::visit([this](auto& what) { take(what); }, event);
  }

  [[nodiscard]] std::vector<Action> advance(const Instant& now) {
    if (!leaves_at_) {
      perform(run_->advance(is_logical_ ? now.wall : now.run));
      if (run_->finished()) {
        const LabRunResult& result = run_->result();
        actions_.emplace_back(result.exit_code == kExitGood ? machine::info("steps driven")
                                                            : machine::error(result.reason));
        leaves_at_ = now.wall + kLeaveTime;
      }
    }
    if (leaves_at_ && (trigger_readers_.empty() || now.wall >= *leaves_at_)) {
      exit_code_ = run_->result().exit_code;
    }
    return std::exchange(actions_, {});
  }
  [[nodiscard]] WakeUp wake_up() const {
    if (leaves_at_) return {.wall = *leaves_at_};
    const Nanoseconds at = run_->wake_up();
    if (at == ~Nanoseconds{0}) return {};
    return is_logical_ ? WakeUp{.wall = at} : WakeUp{.run = at};
  }
  [[nodiscard]] std::size_t awaited() const {
    return std::max<std::size_t>(run_->answers_owed(), 1);
  }
  [[nodiscard]] std::optional<int> exit_code() const { return exit_code_; }
  [[nodiscard]] const LabRun& run() const { return *run_; }

 private:
  void take(const machine::StopSignal& /*signal*/) { run_->interrupt(); }
  void take(LabPresence& presence) {
    trigger_readers_ = presence.trigger_readers;
    run_->presence(presence.alive, presence.lost);
    run_->trigger_readers(std::move(presence.trigger_readers));
  }
  void take(const ReadyStatus& status) { run_->ready(status); }
  void take(const ReportRecord& record) { run_->report(record); }
  void take(const VehicleState& state) { run_->state(state); }
  void take(const StopRequest& request) { run_->stop_requested(request.vehicle_id); }
  void take(const ParameterRequest& request) {
    if (request.name == kPeriodParameter) {
      const std::uint64_t period_ms = settings_.period / kNanosecondsPerMillisecond;
      actions_.emplace_back(Parameter{.name = request.name, .value = period_ms});
    } else if (request.name == kActiveIdsParameter) {
      const std::vector<std::uint8_t>& ids = settings_.vehicle_ids;
      actions_.emplace_back(Parameter{.name = request.name,
                                      .value = std::vector<std::int32_t>(ids.begin(), ids.end())});
    }
  }

  void perform(const LabRunActions& todo) {
    for (const Death& death : todo.deaths) {
      actions_.emplace_back(machine::error(death.process + " died: " + death.sign));
    }
    for (const std::string& process : todo.returns) {
      actions_.emplace_back(machine::info(process + " is back"));
    }
    if (todo.run_state) {
      if (!is_logical_ && start_ == 0 && !todo.triggers.empty()) start_ = todo.triggers.front();
      actions_.emplace_back(RunState{.phase = *todo.run_state, .start = start_});
    }
    for (const Nanoseconds trigger : todo.triggers) {
      actions_.emplace_back(SystemTrigger{.next_start = trigger});
    }
  }

  LabRunSettings settings_;
  bool is_logical_;
  std::unique_ptr<LabRun> run_;
  std::vector<Action> actions_;
  std::set<std::string> trigger_readers_;
  Nanoseconds start_{};
  std::optional<Nanoseconds> leaves_at_;
  std::optional<int> exit_code_;
};

/// The endpoints of the lab control, as lab_control_process.cpp has them.
class LabControlHost : public Host {
 public:
  using Machine = LabControlMachine;
  using Host::perform;

  [[nodiscard]] static NodeDescription description(const std::vector<std::uint8_t>& all,
                                                   bool is_logical) {
    NodeDescription description{
        .name = kLabControlName,
        .writes = {{TopicId::kSystemTrigger}, {TopicId::kParameter}, {TopicId::kRunState}},
        .reads = {{TopicId::kReadyStatus},
                  {TopicId::kParameterRequest},
                  {TopicId::kStopRequest},
                  {TopicId::kReport}}};
    if (is_logical) return description;
    for (const std::uint8_t id : all) description.reads.push_back({TopicId::kVehicleState, id});
    return description;
  }
  void attach(const ProcessPlace& place, const LabControlMachine& machine) {
    set_place(place);
    machine_ = &machine;
  }

  template <class Process>
  void receive(std::size_t topic, const Message& message, Process& process) {
    switch (topic) {
      case kReady:
        return process.post(std::get<ReadyStatus>(message));
      case kRequests:
        return process.post(std::get<ParameterRequest>(message));
      case kStopRequests:
        return process.post(std::get<StopRequest>(message));
      case kReports:
        return process.post(std::get<ReportRecord>(message));
      default:
        break;
    }
    if (machine_->run().phase() != LabRun::Phase::kGathering) return;
    process.post(std::get<VehicleState>(message));
  }

  [[nodiscard]] LabPresence presence() const {
    const machine::Participants lab = participants(Domain::kLab);
    const machine::Participants controllers = participants(Domain::kControllers);
    LabPresence presence{
        .alive = lab.alive, .lost = lab.lost, .trigger_readers = readers(kTriggers)};
    presence.alive.insert(controllers.alive.begin(), controllers.alive.end());
    presence.lost.insert(controllers.lost.begin(), controllers.lost.end());
    return presence;
  }

  void perform(const SystemTrigger& trigger) const { publish(kTriggers, trigger); }
  void perform(const Parameter& parameter) const { publish(kParameters, parameter); }
  void perform(const RunState& state) const { publish(kRunStates, state); }

 private:
  enum Writes : std::size_t { kTriggers, kParameters, kRunStates };
  enum Reads : std::size_t { kReady, kRequests, kStopRequests, kReports };

  const LabControlMachine* machine_{};
};

}  // namespace hlc::closed_loop
