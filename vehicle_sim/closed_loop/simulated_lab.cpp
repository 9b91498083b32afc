#include "vehicle_sim/closed_loop/simulated_lab.hpp"

#include <algorithm>
#include <utility>

#include "vehicle_sim/closed_loop/seeded_random.hpp"

namespace hlc::closed_loop {
namespace {

/// True time at which a run begins: whole steps, and far from 0, so that no clock shows less.
constexpr Nanoseconds kBegin = 1000 * kNanosecondsPerSecond;
constexpr Nanoseconds kLastStart = kNanosecondsPerSecond / 2;
constexpr Nanoseconds kLeastReaction = 20'000;
constexpr Nanoseconds kMostReaction = 150'000;
constexpr Nanoseconds kMostClockError = 200'000;
constexpr Nanoseconds kMostDrift_ppb = 20'000;

NetworkOptions network_options(const LabSettings& settings) {
  return {.seed = mixed(settings.seed, 1),
          .transport = settings.transport,
          .lease = machine::run_time(settings.is_logical).lease,
          .least_delay = 50'000,
          .most_delay = settings.is_logical ? Nanoseconds{200'000} : kNanosecondsPerMillisecond};
}

}  // namespace

SimulatedLab::SimulatedLab(const scenario::Scenario& scenario, const LabSettings& settings,
                           RunObserver& observer)
    : settings_(settings),
      factory_(scenario, settings),
      observer_(&observer),
      queue_(kBegin),
      now_(kBegin),
      network_(queue_, network_options(settings)) {
  for (const ProcessKey& key : factory_.processes()) add_seat(key);
}

void SimulatedLab::add_seat(const ProcessKey& key) {
  SeededRandom random(mixed(settings_.seed, 1000 + seats_.size()));
  const auto drift_ppb = static_cast<std::int64_t>(random.below(2 * kMostDrift_ppb + 1)) -
                         static_cast<std::int64_t>(kMostDrift_ppb);
  const Nanoseconds shows = kBegin + random.below(2 * kMostClockError + 1) - kMostClockError;
  const Nanoseconds uptime = random.between(1, 1'000'000) * kNanosecondsPerMillisecond;
  Seat seat{.key = key, .name = name_of(key)};
  seat.run_clock = SimulatedClock(kBegin, shows, drift_ppb);
  seat.wall_clock = SimulatedClock(kBegin, uptime, drift_ppb);
  queue_.add(kBegin + random.below(kLastStart),
             {.what = Happening::kStart, .detail = static_cast<std::uint32_t>(seats_.size())});
  by_name_[seat.name] = seats_.size();
  seats_.push_back(std::move(seat));
}

Nanoseconds SimulatedLab::now() const { return now_ - kBegin; }

void SimulatedLab::set_alarm(Nanoseconds at, std::uint32_t number) {
  queue_.add(kBegin + at, {.what = Happening::kAlarm, .detail = number});
}

std::optional<std::uint32_t> SimulatedLab::step() {
  Event event = queue_.take();
  now_ = queue_.now();
  switch (event.what) {
    case Happening::kArrival:
      arrive(std::move(event));
      break;
    case Happening::kSight:
      look(event);
      break;
    case Happening::kWakeUp: {
      Seat* const seat = seat_of(event.node);
      if (seat && !seat->is_frozen && seat->generation == event.generation) turn(*seat);
      break;
    }
    case Happening::kStart:
      // A process that was killed before its first start is started at the end of that fault.
      if (!seats_[event.detail].is_killed) start(seats_[event.detail]);
      break;
    case Happening::kAlarm:
      return event.detail;
  }
  return std::nullopt;
}

bool SimulatedLab::is_deserted() const {
  return std::ranges::all_of(
      seats_, [](const Seat& seat) { return !seat.process && !seat.is_killed && seat.exit_code; });
}

// --- turns --------------------------------------------------------------------------------------

void SimulatedLab::start(Seat& seat) {
  if (seat.process) return;
  seat.node = network_.join(factory_.description(seat.key));
  by_node_.push_back(static_cast<std::size_t>(&seat - seats_.data()));
  seat.is_killed = false;
  seat.planned_turn = kNoTurn;
  on_change(seat);
  const ProcessPlace place{.node = seat.node,
                           .network = &network_,
                           .observer = observer_,
                           .run_clock = &seat.run_clock,
                           .wall_clock = &seat.wall_clock,
                           .now = &now_,
                           .is_logical = settings_.is_logical};
  seat.process = factory_.make(seat.key, place, pose_of(seat.key.vehicle));
  plan_turn(seat);
}

/// When the process has its next turn, if that is earlier than what was planned.
void SimulatedLab::plan_turn(Seat& seat) {
  if (!seat.process || seat.is_frozen) return;
  const Nanoseconds next = seat.process->next_turn();
  if (next == kNoTurn) return;
  const Nanoseconds reaction =
      kLeastReaction +
      mixed(settings_.seed ^ seat.node, seat.num_plans++) % (kMostReaction - kLeastReaction);
  const Nanoseconds at = std::max(next, now_) + reaction;
  if (at >= seat.planned_turn) return;
  seat.planned_turn = at;
  queue_.add(at, {.what = Happening::kWakeUp, .node = seat.node, .generation = ++seat.generation});
}

void SimulatedLab::turn(Seat& seat) {
  seat.planned_turn = kNoTurn;
  ++seat.num_turns;
  seat.process->turn();
  seat.exit_code = seat.process->exit_code();
  if (!seat.exit_code) return plan_turn(seat);
  network_.leave(seat.node);
  seat.process.reset();
  on_change(seat);
}

Seat* SimulatedLab::seat_of(NodeId node) {
  Seat& seat = seats_[by_node_[node]];
  return seat.process && seat.node == node ? &seat : nullptr;
}

void SimulatedLab::arrive(Event event) {
  const auto arrival = network_.arrive(std::move(event));
  if (!arrival) return;
  Seat* const seat = seat_of(arrival->node);
  if (!seat) return;
  if (seat->is_frozen) {
    seat->unread.emplace_back(arrival->topic, arrival->message);
    return;
  }
  seat->process->receive(arrival->topic, *arrival->message);
  plan_turn(*seat);
}

void SimulatedLab::look(const Event& event) {
  if (!network_.look(event)) return;
  Seat* const seat = seat_of(event.node);
  if (!seat) return;
  seat->process->presence_changed();
  plan_turn(*seat);
}

// --- faults -------------------------------------------------------------------------------------

void SimulatedLab::kill(Seat& seat) {
  if (seat.exit_code) return;
  seat.is_killed = true;
  seat.is_frozen = false;
  seat.unread.clear();
  if (!seat.process) return;
  seat.process.reset();
  network_.vanish(seat.node);
}

void SimulatedLab::restart(Seat& seat) {
  if (seat.is_killed) start(seat);
}

void SimulatedLab::freeze(Seat& seat) {
  if (!seat.process) return;
  seat.is_frozen = true;
  seat.planned_turn = kNoTurn;
  ++seat.generation;
  network_.freeze(seat.node);
}

void SimulatedLab::thaw(Seat& seat) {
  if (!seat.process || !seat.is_frozen) return;
  seat.is_frozen = false;
  for (const auto& [topic, message] : std::exchange(seat.unread, {})) {
    seat.process->receive(topic, *message);
  }
  network_.thaw(seat.node);
  plan_turn(seat);
}

void SimulatedLab::interrupt(Seat& seat) {
  if (!seat.process) return;
  seat.process->stop();
  plan_turn(seat);
}

void SimulatedLab::set_clocks(Seat& seat, std::int64_t step, std::int64_t drift_ppb) {
  if (step != 0) seat.run_clock.step(now_, step);
  if (drift_ppb != 0) {
    for (SimulatedClock* clock : {&seat.run_clock, &seat.wall_clock}) {
      clock->set_drift(now_, clock->drift_ppb() + drift_ppb);
    }
  }
  if (!seat.process) return;
  seat.process->clocks_changed();
  plan_turn(seat);
}

}  // namespace hlc::closed_loop
