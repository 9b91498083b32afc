#pragma once

#include <cstdint>

#include "vehicle_sim/closed_loop/host.hpp"
#include "vehicle_sim/vehicle/vehicle_machine.hpp"

namespace hlc::closed_loop {

/// The endpoints of a simulated vehicle, as in vehicle_process.cpp.
class VehicleHost : public Host {
 public:
  using Machine = simulated_vehicle::VehicleMachine;
  using Host::perform;

  explicit VehicleHost(std::uint8_t vehicle) : vehicle_(vehicle) {}

  [[nodiscard]] static NodeDescription description(std::uint8_t vehicle) {
    return {
        .name = vehicle_name(vehicle),
        .writes = {{TopicId::kVehicleState, vehicle},
                   {TopicId::kReadyStatus},
                   {TopicId::kParameterRequest}},
        .reads = {
            {TopicId::kVehicleCommand, vehicle}, {TopicId::kParameter}, {TopicId::kSystemTrigger}}};
  }
  void attach(const ProcessPlace& place, const simulated_vehicle::VehicleMachine& /*machine*/) {
    set_place(place);
  }

  template <class Process>
  void receive(std::size_t topic, const Message& message, Process& process) {
    switch (topic) {
      case kCommands:
        place().observer->on_received(std::get<TrajectoryCommand>(message));
        return process.post(std::get<TrajectoryCommand>(message));
      case kParameters:
        return process.post(std::get<Parameter>(message));
      default:
        break;
    }
    const auto& trigger = std::get<SystemTrigger>(message);
    process.trigger(trigger.next_start);
    if (trigger.next_start != kStopSymbol) return;
    place().observer->on_stop_symbol(vehicle_);
    process.post_urgent(trigger);
  }

  [[nodiscard]] simulated_vehicle::VehiclePresence presence() const {
    const auto matched = [](std::set<std::string> names) {
      const std::size_t count = names.size();
      return machine::Matched{.count = count, .names = std::move(names)};
    };
    return {.lab = participants(Domain::kLab),
            .state_readers = matched(readers(kStates)),
            .command_writers = matched(writers(kCommands)),
            .ready_readers = readers(kReady).size(),
            .trigger_writers = writers(kTriggers).size()};
  }

  void perform(const VehicleState& state) const { publish(kStates, state); }
  void announce_tick(const ReadyStatus& status) const { publish(kReady, status); }
  void perform(const ParameterRequest& request) const { publish(kRequests, request); }
  void perform(const VehicleObservation& /*observation*/) const {}
  void perform(const result::DrivenSample& sample) const {
    Nanoseconds time = sample.t;
    if (!place().is_logical) {
      // By its clock; ticks that it has to make up for lie in the past.
      const Nanoseconds now = *place().now;
      const Nanoseconds shown = place().run_clock->at(now);
      time = now - (shown - std::min(shown, sample.t));
    }
    place().observer->on_driven(vehicle_, time, sample);
  }

 private:
  enum Writes : std::size_t { kStates, kReady, kRequests };
  enum Reads : std::size_t { kCommands, kParameters, kTriggers };

  std::uint8_t vehicle_;
};

}  // namespace hlc::closed_loop
