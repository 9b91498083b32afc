#include "hlc_bridge/middleware/middleware_machine.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "hlc_bridge/messages/exit_codes.hpp"
#include "hlc_bridge/messages/node_names.hpp"

namespace hlc::middleware {
namespace {

std::set<std::uint8_t> silent_at_first(const MiddlewareSettings& settings) {
  if (settings.rules.awaits_first_answers) return {};
  return {settings.vehicle_ids.begin(), settings.vehicle_ids.end()};
}

}  // namespace

MiddlewareMachine::MiddlewareMachine(MiddlewareSettings settings)
    : settings_{std::move(settings)},
      start_up_{settings_.startup_timeout},
      lists_{settings_.rules.lists_observations},
      due_states_{vehicle_name, settings_.rules.pacing.patience},
      due_answers_{controller_name, settings_.rules.pacing.patience, silent_at_first(settings_)},
      forwarder_{settings_.vehicle_ids},
      cycle_{settings_.vehicle_ids, settings_.offset, settings_.keep_running},
      grace_{settings_.rules.pacing.lab_control_grace} {}

std::vector<MiddlewareAction> MiddlewareMachine::advance(const Instant& now) {
  for (Event& event : std::exchange(inbox_.events, {})) {
    std::visit([&](auto& what) { take(what, now); }, event);
  }
  look_for_end(now);
  if (phase_ == Phase::kStarting) start(now);
  tick(now);
  return std::exchange(actions_, {});
}

WakeUp MiddlewareMachine::wake_up() const {
  switch (phase_) {
    case Phase::kStarting:
      return {.wall = start_up_.wake_up()};
    case Phase::kIdle:
      return {.run = ticks_->next()};
    case Phase::kStates:
      return {.wall = due_states_.deadline()};
    case Phase::kAnswers:
      return {.wall = due_answers_.deadline()};
    case Phase::kLeaving:
      return {.wall = ending_.until};
    case Phase::kFinished:
      break;
  }
  return {};
}

/// Commands are urgent: they are forwarded at once, so answers need not be counted.
std::size_t MiddlewareMachine::awaited() const {
  switch (phase_) {
    case Phase::kIdle:
    case Phase::kAnswers:
      return machine::kOnlyUrgent;
    case Phase::kStates:
      return std::max<std::size_t>(due_states_.awaited(), 1);
    default:
      return 1;
  }
}

std::optional<int> MiddlewareMachine::exit_code() const {
  return phase_ == Phase::kFinished ? std::optional{ending_.exit_code} : std::nullopt;
}

// --- events -------------------------------------------------------------------------------------

/// Our controllers answer every list, from the first one on.
void MiddlewareMachine::take(MiddlewarePeers& peers, const Instant& /*now*/) {
  for (const std::uint8_t id : peers.own_controllers) {
    if (!peers_.own_controllers.contains(id)) due_answers_.received(id);
  }
  peers_ = std::move(peers);
}

void MiddlewareMachine::take(const Parameter& parameter, const Instant& /*now*/) {
  if (cycle_.has_begun()) {
    cycle_.take(parameter);
  } else {
    start_up_.take(parameter);
  }
}

void MiddlewareMachine::take(const SystemTrigger& trigger, const Instant& /*now*/) {
  if (settings_.rules.forwards_every_trigger || trigger.next_start == kStopSymbol ||
      !cycle_.is_triggered()) {
    actions_.emplace_back(trigger);
  }
  cycle_.take(trigger);
}

void MiddlewareMachine::take(GoalState& goal, const Instant& /*now*/) {
  cycle_.take(std::move(goal));
}

bool MiddlewareMachine::is_plausible(const machine::StampedMessage& message, const Instant& now) {
  const Nanoseconds period = cycle_.has_begun() ? cycle_.parameters().period() : 0;
  return inbox_.stamp_check.accepts(message, now, period, actions_);
}

void MiddlewareMachine::take(const PublishedState& published, const Instant& now) {
  const VehicleState& state = published.state;
  if (!is_plausible({"state", vehicle_name, published.vehicle_id,
                     std::max(state.create_stamp, state.valid_after_stamp)},
                    now)) {
    return;
  }
  lists_.add(published.vehicle_id, state);
  due_states_.received(published.vehicle_id);
}

void MiddlewareMachine::take(const PublishedObservation& published, const Instant& now) {
  if (!is_plausible(
          {"observation", vehicle_name, published.vehicle_id, published.observation.create_stamp},
          now)) {
    return;
  }
  lists_.add(published.vehicle_id, published.observation);
}

void MiddlewareMachine::take(const ReadyStatus& status, const Instant& /*now*/) {
  cycle_.take(status);
}

void MiddlewareMachine::take(VehicleCommand& command, const Instant& now) {
  const std::uint8_t id = vehicle_of(command);
  const auto stamp = std::visit([](const auto& any) { return any.create_stamp; }, command);
  if (!is_plausible({"command", controller_name, id, stamp}, now)) return;
  due_answers_.received(id);
  forwarder_.receive(std::move(command), now.run, lists_.newest_list(), cycle_.withholds_commands(),
                     actions_);
}

// --- start and end ------------------------------------------------------------------------------

void MiddlewareMachine::start(const Instant& now) {
  const auto end_with = [&](int exit_code) {
    ending_.exit_code = exit_code;
    phase_ = Phase::kFinished;
  };
  if (!cycle_.has_begun()) {
    if (start_up_.learn(now.wall, actions_)) {
      if (std::string problem = cycle_.begin(start_up_.parameters()); !problem.empty()) {
        actions_.emplace_back(machine::error(std::move(problem)));
        return end_with(kExitBadInput);
      }
      actions_.emplace_back(SubscribeToVehicles{cycle_.parameters().active_ids()});
    }
  }
  const bool is_ready =
      cycle_.has_begun() && (!settings_.rules.pacing.connects_before_start ||
                             start_up_.connect(now.wall, missing_peers(), actions_));
  if (start_up_.exit_code()) return end_with(*start_up_.exit_code());
  if (!is_ready) return;
  ticks_.emplace(cycle_.parameters().period(), settings_.offset, now);
  phase_ = Phase::kIdle;
}

/// No message of the run may be lost, since ticks wait for it.
std::string MiddlewareMachine::missing_peers() const {
  std::vector<std::string> missing;
  if (!peers_.lab_control_is_matched) missing.emplace_back(kLabControlName);
  if (!peers_.controllers_are_matched) {
    for (const std::uint8_t id : settings_.vehicle_ids) missing.push_back(controller_name(id));
  }
  for (const std::int32_t active : cycle_.parameters().active_ids()) {
    const auto id = static_cast<std::uint8_t>(active);
    const bool is_own = std::ranges::count(settings_.vehicle_ids, id) > 0;
    if (!peers_.state_publishers.contains(id) ||
        (is_own && !peers_.command_subscribers.contains(id))) {
      missing.push_back(vehicle_name(id));
    }
  }
  return fmt::format("{}", fmt::join(missing, ", "));
}

void MiddlewareMachine::look_for_end(const Instant& now) {
  if (phase_ == Phase::kLeaving && (!peers_.commands_are_sent || now.wall >= ending_.until)) {
    phase_ = Phase::kFinished;
  }
  if (phase_ == Phase::kLeaving || phase_ == Phase::kFinished) return;
  if (ending_.is_asked || cycle_.is_stopped()) return leave(kExitGood, now);
  if (phase_ == Phase::kStarting) return;
  if (grace_.is_over(peers_.lab_control_is_lost, now.wall)) {
    actions_.emplace_back(machine::error(std::string{kLabControlName} + " lost"));
    leave(kExitDied, now);
  }
}

void MiddlewareMachine::leave(int exit_code, const Instant& now) {
  if (forwarder_.missed_answers() > 0) {
    actions_.emplace_back(machine::warning(
        fmt::format("{} lists without an answer in time", forwarder_.missed_answers())));
  }
  if (inbox_.stamp_check.dropped() > 0) {
    actions_.emplace_back(machine::warning(
        fmt::format("{} messages dropped because of their stamps", inbox_.stamp_check.dropped())));
  }
  const bool is_awaited = cycle_.is_stopped() && peers_.commands_are_sent;
  ending_.exit_code = exit_code;
  ending_.until = now.wall + kLeaveTime;
  phase_ = is_awaited ? Phase::kLeaving : Phase::kFinished;
}

// --- the tick -----------------------------------------------------------------------------------

void MiddlewareMachine::tick(const Instant& now) {
  if (phase_ == Phase::kIdle) {
    if (const std::optional<Nanoseconds> due = ticks_->take(now)) begin_tick(*due, now);
  }
  if (phase_ == Phase::kStates && !awaits_controllers(now) && states_are_in(now)) {
    publish_list(now);
  }
  if (phase_ == Phase::kAnswers && answers_are_in(now)) phase_ = Phase::kIdle;
}

void MiddlewareMachine::begin_tick(Nanoseconds t_now, const Instant& now) {
  t_now_ = t_now;
  phase_ = Phase::kStates;
  due_states_.begin(now.wall);
  if (!waits() && lists_.newest_list() != 0 && cycle_.is_running_at(lists_.newest_list())) {
    forwarder_.count_missed_answers(lists_.newest_list(), actions_);
  }
  cycle_.prepare_next(now.wall, actions_);
}

void MiddlewareMachine::publish_list(const Instant& now) {
  actions_.emplace_back(lists_.compose(t_now_, cycle_.parameters()));
  cycle_.forward_goals(actions_);
  if (settings_.rules.announces_readiness) cycle_.announce_readiness(now.wall, actions_);
  phase_ = Phase::kAnswers;
  due_answers_.begin(now.wall);
}

bool MiddlewareMachine::awaits_controllers(const Instant& now) {
  const bool is_first = lists_.newest_list() == 0;
  const bool must_wait = waits() && !settings_.rules.pacing.connects_before_start && is_first;
  if (!must_wait || peers_.controllers_are_matched) return false;
  if (now.wall < due_states_.deadline()) return true;
  actions_.emplace_back(machine::warning("no controller is matched; time passes without one"));
  return false;
}

bool MiddlewareMachine::states_are_in(const Instant& now) {
  const std::optional<Nanoseconds> stamp = newest_valid_state_stamp(t_now_);
  if (!waits() || !stamp) return true;
  std::vector<std::uint8_t> pending;
  for (const std::uint8_t id : peers_.state_publishers) {
    if (!lists_.holds_state(id, *stamp)) pending.push_back(id);
  }
  return due_states_.are_in(pending, now.wall, actions_);
}

bool MiddlewareMachine::answers_are_in(const Instant& now) {
  if (!waits() || !peers_.commands_are_sent) return true;
  std::vector<std::uint8_t> pending = forwarder_.unanswered(t_now_);
  std::erase_if(pending, [this](std::uint8_t id) { return peers_.lost_controllers.contains(id); });
  return due_answers_.are_in(pending, now.wall, actions_);
}

}  // namespace hlc::middleware
