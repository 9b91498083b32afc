#pragma once

#include <cstdint>
#include <set>
#include <utility>
#include <variant>
#include <vector>

#include "hlc_bridge/middleware/middleware_machine.hpp"
#include "vehicle_sim/closed_loop/host.hpp"

namespace hlc::closed_loop {

/// The endpoints of the middleware of one vehicle, as in middleware_process.cpp.
class MiddlewareHost : public Host {
 public:
  using Machine = middleware::MiddlewareMachine;
  using Host::perform;

  MiddlewareHost(std::uint8_t vehicle, std::vector<std::uint8_t> all)
      : vehicle_(vehicle), all_(std::move(all)) {}

  [[nodiscard]] static NodeDescription description(std::uint8_t vehicle,
                                                   const std::vector<std::uint8_t>& all) {
    NodeDescription description{.name = middleware_name(vehicle),
                                .writes = {{TopicId::kStateList, vehicle},
                                           {TopicId::kForwardedTrigger, vehicle},
                                           {TopicId::kVehicleCommand, vehicle},
                                           {TopicId::kReadyStatus},
                                           {TopicId::kParameterRequest}},
                                .reads = {{TopicId::kParameter},
                                          {TopicId::kSystemTrigger},
                                          {TopicId::kCommand, vehicle},
                                          {TopicId::kControllerReady, vehicle}}};
    for (const std::uint8_t id : all) description.reads.push_back({TopicId::kVehicleState, id});
    return description;
  }
  void attach(const ProcessPlace& place, const middleware::MiddlewareMachine& /*machine*/) {
    set_place(place);
  }

  template <class Process>
  void receive(std::size_t topic, const Message& message, Process& process) {
    switch (topic) {
      case kParameters:
        return process.post(std::get<Parameter>(message));
      case kTriggers:
        return take(std::get<SystemTrigger>(message), process);
      case kCommands:
        return process.post_urgent(
            middleware::VehicleCommand{std::get<TrajectoryCommand>(message)});
      case kControllerReady:
        return process.post(std::get<ReadyStatus>(message));
      default:
        break;
    }
    const std::uint8_t id = all_[topic - kFirstStates];
    if (subscribed_.contains(id)) {
      process.post(
          middleware::PublishedState{.vehicle_id = id, .state = std::get<VehicleState>(message)});
    }
  }

  [[nodiscard]] middleware::MiddlewarePeers presence() const {
    const machine::Participants local = participants(Domain::kLocal);
    middleware::MiddlewarePeers peers;
    peers.lab_control_is_matched = !readers(kReady).empty() && !writers(kTriggers).empty();
    peers.lab_control_is_lost = participants(Domain::kLab).lost.contains(kLabControlName);
    peers.commands_are_sent = !writers(kCommands).empty();
    peers.controllers_are_matched = peers.commands_are_sent && !readers(kLists).empty() &&
                                    !readers(kForwarded).empty() &&
                                    !writers(kControllerReady).empty();
    if (local.lost.contains(controller_name(vehicle_))) peers.lost_controllers.insert(vehicle_);
    for (std::size_t i = 0; i < all_.size(); ++i) {
      const bool is_read = subscribed_.contains(all_[i]);
      if (is_read && !writers(kFirstStates + i).empty()) peers.state_publishers.insert(all_[i]);
    }
    if (!readers(kVehicleCommands).empty()) peers.command_subscribers.insert(vehicle_);
    return peers;
  }

  void perform(const middleware::SubscribeToVehicles& subscribe) {
    for (const std::int32_t id : subscribe.vehicle_ids) {
      subscribed_.insert(static_cast<std::uint8_t>(id));
    }
    has_subscribed_ = true;
  }
  void perform(const VehicleStateList& list) const { publish(kLists, list); }
  void perform(const SystemTrigger& trigger) const { publish(kForwarded, trigger); }
  void perform(const GoalState& /*goal*/) const {}
  void perform(const middleware::VehicleCommand& command) const {
    publish(kVehicleCommands, std::get<TrajectoryCommand>(command));
  }
  void perform(const ReadyStatus& status) const { publish(kReady, status); }
  void announce_tick(const ReadyStatus& status) const { perform(status); }
  void perform(const ParameterRequest& request) const { publish(kRequests, request); }

  /// True once after new readers were created: matches must be checked again.
  [[nodiscard]] bool take_change_of_endpoints() { return std::exchange(has_subscribed_, false); }

 private:
  enum Writes : std::size_t { kLists, kForwarded, kVehicleCommands, kReady, kRequests };
  enum Reads : std::size_t { kParameters, kTriggers, kCommands, kControllerReady, kFirstStates };

  template <class Process>
  void take(const SystemTrigger& trigger, Process& process) {
    const bool is_first = !std::exchange(is_triggered_, true);
    if (is_first || trigger.next_start == kStopSymbol || !place().is_logical) {
      process.post_urgent(trigger);
    } else {
      process.post(trigger);
    }
    process.trigger(trigger.next_start);
  }

  std::uint8_t vehicle_;
  std::vector<std::uint8_t> all_;
  std::set<std::uint8_t> subscribed_;
  bool is_triggered_{};
  bool has_subscribed_{};
};

}  // namespace hlc::closed_loop
