#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "hlc_bridge/lab_control/lab_control_machine.hpp"
#include "vehicle_sim/closed_loop/host.hpp"

namespace hlc::closed_loop {

/// The endpoints of the lab control, as in lab_control_process.cpp.
class LabControlHost : public Host {
 public:
  using Machine = lab_control::LabControlMachine;
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
  void attach(const ProcessPlace& place, const lab_control::LabControlMachine& machine) {
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
    if (is_gathering_) process.post(std::get<VehicleState>(message));
  }

  [[nodiscard]] lab_control::LabControlPresence presence() const {
    machine::Participants both = participants(Domain::kLab);
    const machine::Participants controllers = participants(Domain::kControllers);
    both.alive.insert(controllers.alive.begin(), controllers.alive.end());
    both.lost.insert(controllers.lost.begin(), controllers.lost.end());
    std::set<std::string> reached = readers(kTriggers);
    const std::size_t count = reached.size();
    return {.participants = std::move(both),
            .trigger_readers = {.count = count, .names = std::move(reached)}};
  }

  void perform(const ReportRecord& /*record*/) const {}
  void perform(const Log& /*log*/) const {}
  void perform(const lab_control::ProgressText& progress) const {
    place().observer->on_progress(progress.text);
  }
  void perform(const SystemTrigger& trigger) const { publish(kTriggers, trigger); }
  void perform(const Parameter& parameter) const { publish(kParameters, parameter); }
  void perform(const RunState& state) {
    is_gathering_ = false;
    publish(kRunStates, state);
  }
  /// The run's result, which the process logs last.
  void log_end() const {
    const lab_control::LabRunResult& result = machine_->run().result();
    perform(result.exit_code == kExitGood ? machine::info("all steps driven")
                                          : machine::error(result.reason));
  }

 private:
  enum Writes : std::size_t { kTriggers, kParameters, kRunStates };
  enum Reads : std::size_t { kReady, kRequests, kStopRequests, kReports };

  const lab_control::LabControlMachine* machine_{};
  bool is_gathering_{true};
};

}  // namespace hlc::closed_loop
