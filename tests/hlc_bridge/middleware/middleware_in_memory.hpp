#pragma once

#include <algorithm>
#include <cstdint>
#include <set>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "hlc_bridge/messages/node_names.hpp"
#include "hlc_bridge/middleware/middleware_machine.hpp"

namespace hlc::test {

inline constexpr Nanoseconds kMs = kNanosecondsPerMillisecond;
inline constexpr Nanoseconds kPeriod = 200 * kMs;

inline VehicleState state(std::uint8_t id, Nanoseconds create) {
  VehicleState state;
  state.vehicle_id = id;
  state.create_stamp = create;
  state.valid_after_stamp = create + kStateDelay;
  return state;
}

inline middleware::PublishedState published_state(std::uint8_t id, Nanoseconds create) {
  return {.vehicle_id = id, .state = state(id, create)};
}

/// A command without fault at time `t_now`, once that is later than 50 ms.
inline TrajectoryCommand command(std::uint8_t id, Nanoseconds t_now) {
  TrajectoryCommand command;
  command.vehicle_id = id;
  command.create_stamp = command.valid_after_stamp = t_now;
  const Nanoseconds begin = t_now - std::min(t_now, 50 * kMs);
  for (Nanoseconds i = 0; i < 4; ++i) {
    command.points.push_back({begin + i * 50 * kMs, 1.0, 2.0, 0.5, 0.0});
  }
  return command;
}

/// Parameters from the lab control.
inline RunParameters run_parameters(std::uint64_t period_ms,
                                    const std::vector<std::int32_t>& active_ids) {
  RunParameters parameters;
  parameters.take({.name = kPeriodParameter, .value = period_ms});
  parameters.take({.name = kActiveIdsParameter, .value = active_ids});
  return parameters;
}

/// A middleware machine with its actions so far, and the two clocks that it is advanced
/// by. In logical time `run` is moved by release(), in real time by pass().
class MiddlewareInMemory {
 public:
  explicit MiddlewareInMemory(middleware::MiddlewareSettings settings)
      : vehicle_ids_{settings.vehicle_ids}, machine_{std::move(settings)} {}

  /// Logical time: no tick has been released.
  void begin_in_logical_time() { now_ = {.run = 0, .wall = now_.wall, .has_begun = false}; }

  void post(middleware::MiddlewareEvent event) { machine_.on(std::move(event)); }
  void on(middleware::MiddlewareEvent event) {
    post(std::move(event));
    advance();
  }
  void advance() {
    for (middleware::MiddlewareAction& action : machine_.advance(now_))
      actions_.push_back(std::move(action));
  }
  /// Logical time.
  void release(Nanoseconds tick) {
    now_.run = tick;
    now_.has_begun = true;
    advance();
  }
  /// Real time; the thread comes back this late, whatever the machine wanted.
  void pass(Nanoseconds time) {
    now_.run += time;
    now_.wall += time;
    advance();
  }
  /// Wall time alone.
  void wait(Nanoseconds time) {
    now_.wall += time;
    advance();
  }

  void publish_parameters(std::uint64_t period_ms, const std::vector<std::int32_t>& active_ids) {
    post(Parameter{.name = kPeriodParameter, .value = period_ms});
    on(Parameter{.name = kActiveIdsParameter, .value = active_ids});
  }

  /// All are present: the lab control, the controllers, these vehicles.
  [[nodiscard]] middleware::MiddlewarePeers all_present(
      const std::set<std::uint8_t>& vehicles) const {
    return {.lab_control_is_matched = true,
            .lab_control_is_lost = false,
            .controllers_are_matched = true,
            .commands_are_sent = true,
            .lost_controllers = {},
            .state_publishers = vehicles,
            .command_subscribers = {vehicle_ids_.begin(), vehicle_ids_.end()}};
  }

  /// All actions of one kind so far.
  template <class Kind>
  [[nodiscard]] std::vector<Kind> all() const {
    std::vector<Kind> kinds;
    for (const middleware::MiddlewareAction& action : actions_) {
      if (const auto* kind = std::get_if<Kind>(&action)) kinds.push_back(*kind);
    }
    return kinds;
  }
  [[nodiscard]] const std::vector<middleware::MiddlewareAction>& actions() const {
    return actions_;
  }
  void forget_actions() { actions_.clear(); }

  [[nodiscard]] std::size_t count_lines(const std::string& part) const {
    std::size_t count = 0;
    for (const machine::LogLine& line : all<machine::LogLine>()) {
      if (line.text.find(part) != std::string::npos) ++count;
    }
    return count;
  }

  [[nodiscard]] const middleware::MiddlewareMachine& machine() const { return machine_; }
  [[nodiscard]] const Instant& now() const { return now_; }

 private:
  std::vector<std::uint8_t> vehicle_ids_;
  middleware::MiddlewareMachine machine_;
  Instant now_{.run = 1'000'000 * kPeriod, .wall = 7 * kNanosecondsPerSecond};
  std::vector<middleware::MiddlewareAction> actions_;
};

}  // namespace hlc::test
