#pragma once

#include <cstdint>
#include <set>
#include <string>

#include "hlc_bridge/hlc/hlc_machine.hpp"
#include "vehicle_sim/closed_loop/host.hpp"

namespace hlc::closed_loop {

/// The endpoints of a controller, as in hlc_process.cpp. There are no requests for other subgraphs.
class ControllerHost : public Host {
 public:
  using Machine = high_level_controller::HlcMachine;
  using Host::perform;

  ControllerHost() = default;
  /// @param has_other_bits  digests of its plans are others than those that others compute
  explicit ControllerHost(bool has_other_bits) : has_other_bits_(has_other_bits) {}

  [[nodiscard]] static NodeDescription description(std::uint8_t vehicle) {
    return {.name = controller_name(vehicle),
            .writes = {{TopicId::kTraffic},
                       {TopicId::kPrediction},
                       {TopicId::kOutcome},
                       {TopicId::kCommand, vehicle},
                       {TopicId::kReport},
                       {TopicId::kControllerReady, vehicle},
                       {TopicId::kStopRequest}},
            .reads = {{TopicId::kTraffic},
                      {TopicId::kPrediction},
                      {TopicId::kOutcome},
                      {TopicId::kRunState},
                      {TopicId::kForwardedTrigger, vehicle},
                      {TopicId::kSystemTrigger},
                      {TopicId::kStateList, vehicle}}};
  }
  void attach(const ProcessPlace& place, const high_level_controller::HlcMachine& machine) {
    set_place(place);
    machine_ = &machine;
  }

  template <class Process>
  void receive(std::size_t topic, const Message& message, Process& process) {
    switch (topic) {
      case kReceivedTraffic:
        return process.post(std::get<coordination::Traffic>(message));
      case kReceivedPredictions:
        return process.post(std::get<coordination::Prediction>(message));
      case kReceivedOutcomes:
        return process.post(std::get<coordination::Outcome>(message));
      case kRunStates:
        return process.post_urgent(std::get<RunState>(message));
      case kLists:
        return process.post_urgent(std::get<VehicleStateList>(message));
      default:
        break;
    }
    const auto& trigger = std::get<SystemTrigger>(message);
    if (trigger.next_start == kStopSymbol) {
      if (topic == kForwarded || !place().is_logical) process.post_urgent(trigger);
    } else if (topic == kForwarded) {
      process.post(trigger);
    }
  }

  [[nodiscard]] high_level_controller::HlcPeers presence() const {
    std::set<std::string> receivers = readers(kTraffic);
    for (const std::size_t topic : {kPredictions, kOutcomes}) {
      const std::set<std::string> others = readers(topic);
      std::erase_if(receivers, [&](const std::string& name) { return !others.contains(name); });
    }
    return {.lab = participants(Domain::kLab),
            .local = participants(Domain::kLocal),
            .controllers = participants(Domain::kControllers),
            .receivers = std::move(receivers),
            .command_readers = readers(kCommands).size(),
            .stop_request_readers = readers(kStopRequests).size()};
  }

  void perform(const coordination::Traffic& traffic) const {
    place().observer->on_traffic(traffic, machine_->controller().is_vehicle_seen());
    publish(kTraffic, traffic);
  }
  void perform(const coordination::Prediction& prediction) const {
    place().observer->on_prediction(prediction);
    publish(kPredictions, prediction);
  }
  void perform(const coordination::Outcome& outcome) const {
    coordination::Outcome sent = outcome;
    if (sent.digests) {
      // The others have computed the prediction themselves.
      place().observer->on_prediction(machine_->controller().prediction());
      if (has_other_bits_) ++sent.digests->plan;
    }
    publish(kOutcomes, sent);
  }
  void perform(const TrajectoryCommand& command) const {
    place().observer->on_command(command);
    publish(kCommands, command);
  }
  void perform(const ReportRecord& record) const {
    const controller::Controller& controller = machine_->controller();
    place().observer->on_report(record,
                                controller.has_plan() ? &controller.plan_in_force() : nullptr);
    publish(kReports, record);
  }
  void perform(const ReadyStatus& status) const { publish(kReady, status); }
  void perform(const StopRequest& request) const { publish(kStopRequests, request); }
  void perform(const ParameterRequest& /*request*/) const {}
  void perform(const AutomatonAnswer& /*answer*/) const {}
  void perform(const high_level_controller::PrepareRequest& /*request*/) const {}
  void perform(const high_level_controller::DrawStep& /*step*/) const {}
  void perform(const high_level_controller::AfterStep& /*step*/) const {}

 private:
  enum Writes : std::size_t {
    kTraffic,
    kPredictions,
    kOutcomes,
    kCommands,
    kReports,
    kReady,
    kStopRequests
  };
  enum Reads : std::size_t {
    kReceivedTraffic,
    kReceivedPredictions,
    kReceivedOutcomes,
    kRunStates,
    kForwarded,
    kTriggers,
    kLists
  };

  const high_level_controller::HlcMachine* machine_{};
  bool has_other_bits_{};
};

}  // namespace hlc::closed_loop
