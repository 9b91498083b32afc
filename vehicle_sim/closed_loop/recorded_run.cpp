#include "vehicle_sim/closed_loop/recorded_run.hpp"

#include <algorithm>
#include <iterator>
#include <optional>

#include "hlc_bridge/hlc/hlc_core.hpp"
#include "hlc_bridge/hlc/hlc_rules.hpp"
#include "hlc_bridge/hlc/observation.hpp"
#include "hlc_bridge/messages/time_grid.hpp"
#include "planner/controller/control_loop.hpp"
#include "planner/policy/subgraph_selector.hpp"

namespace hlc::closed_loop {
namespace {

using controller::StepPhase;
using coordination::StepStatus;

class RecordedVehicle {
 public:
  RecordedVehicle(const scenario::Scenario& scenario, const controller::PreparedSubgraph& prepared,
                  VehicleId vehicle, const RecordedMessages& messages)
      : hlc_(scenario::make_controller(scenario, vehicle, prepared)),
        loop_(hlc_.controller()),
        choice_(hlc_.controller(), scenario.reconfiguration),
        messages_(messages) {}

  ReportRecord step(const VehicleStateList& list, const ReportRecord& recorded) {
    controller::Observation observation = hlc_.observe(list).value();
    observation.present = observation.active;
    const bool is_running = recorded.report.status != StepStatus::kStandby;
    if (!hlc_.has_begun()) hlc_.note(list, observation);
    if (is_running) {
      static_cast<void>(
          hlc_.begins(list, observation, high_level_controller::StartRule::kAtTrigger, list.t_now));
      if (!first_step_) first_step_ = observation.step;
    }
    loop_.advance_to(observation.step);
    controller::Controller& controller = hlc_.controller();
    static_cast<void>(choice_.begin_step(
        controller, observation.step, first_step_,
        high_level_controller::battery_voltage_v(list, controller.options().vehicle)));
    controller.set_minimal_risk_stop(recorded.report.status == StepStatus::kMinimalRiskStop);
    ReportRecord record = recorded;
    record.report = is_running ? plan(list, observation, recorded) : loop_.stand_by(observation);
    record.report = high_level_controller::with_answer(std::move(record.report), hlc_.answer(list));
    controller.note_causes(record.report);
    controller.note_bound(record.report);
    if (is_running) choice_.end_step(controller, record.report);
    return record;
  }

 private:
  coordination::Report plan(const VehicleStateList& list,
                            const controller::Observation& observation,
                            const ReportRecord& recorded) {
    static_cast<void>(loop_.begin(observation));
    for (const auto& one : of_step(messages_.traffic, observation.step)) {
      const std::vector<VehicleId>& missing = recorded.report.missing;
      if (std::ranges::count(missing, one.message->vehicle) == 0) loop_.receive(one.message);
    }
    const high_level_controller::StepDeadlines shares;
    while (true) {
      const bool is_last = loop_.phase() == StepPhase::kCommit;
      const double share = is_last ? shares.commit : shares.predecessors;
      deliver_until(high_level_controller::deadline_in_step(list, share), observation.step);
      controller::StepOutput output = is_last && recorded.deadline_missed
                                          ? loop_.fall_back(coordination::FallbackReason::kLate)
                                          : loop_.proceed();
      if (output.report) return *std::move(output.report);
    }
  }

  /// Messages that come twice are kept once by the loop.
  void deliver_until(Nanoseconds deadline, StepIndex step) {
    const auto deliver = [&](const auto& messages) {
      for (const auto& one : of_step(messages, step)) {
        if (one.time < deadline) loop_.receive(one.message);
      }
    };
    deliver(messages_.predictions);
    deliver(messages_.outcomes);
  }

  template <class Message>
  static std::vector<RecordedMessages::Published<Message>> of_step(
      const RecordedMessages::BySteps<Message>& messages, StepIndex step) {
    std::vector<RecordedMessages::Published<Message>> found;
    const auto [begin, end] = messages.equal_range(step);
    std::ranges::transform(begin, end, std::back_inserter(found),
                           [](const auto& one) { return one.second; });
    return found;
  }

  high_level_controller::HlcCore hlc_;
  controller::ControlLoop loop_;
  policy::SubgraphSelector choice_;
  const RecordedMessages& messages_;
  std::optional<StepIndex> first_step_;
};

}  // namespace

std::vector<ReportRecord> drive_recorded(const scenario::Scenario& scenario,
                                         const controller::PreparedSubgraph& prepared,
                                         VehicleId vehicle, const RecordedMessages& messages,
                                         std::span<const ReportRecord> recorded) {
  RecordedVehicle driven(scenario, prepared, vehicle, messages);
  std::vector<ReportRecord> reports;
  for (const ReportRecord& one : recorded) {
    const auto list = messages.lists.find({vehicle, one.report.step});
    if (list == messages.lists.end()) break;
    reports.push_back(driven.step(list->second, one));
  }
  return reports;
}

}  // namespace hlc::closed_loop
