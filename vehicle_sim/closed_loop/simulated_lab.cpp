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
  for (const ProcessKey& key : factory_.processes()) add_slot(key);
}

void SimulatedLab::add_slot(const ProcessKey& key) {
  SeededRandom random(mixed(settings_.seed, 1000 + slots_.size()));
  const auto drift_ppb = static_cast<std::int64_t>(random.below(2 * kMostDrift_ppb + 1)) -
                         static_cast<std::int64_t>(kMostDrift_ppb);
  const Nanoseconds shows = kBegin + random.below(2 * kMostClockError + 1) - kMostClockError;
  const Nanoseconds uptime = random.between(1, 1'000'000) * kNanosecondsPerMillisecond;
  ProcessSlot slot{.key = key, .name = name_of(key)};
  slot.run_clock = SimulatedClock(kBegin, shows, drift_ppb);
  slot.wall_clock = SimulatedClock(kBegin, uptime, drift_ppb);
  queue_.add(kBegin + random.below(kLastStart),
             {.what = EventKind::kStart, .detail = static_cast<std::uint32_t>(slots_.size())});
  by_name_[slot.name] = slots_.size();
  slots_.push_back(std::move(slot));
}

Nanoseconds SimulatedLab::now() const { return now_ - kBegin; }

void SimulatedLab::set_alarm(Nanoseconds at, std::uint32_t number) {
  queue_.add(kBegin + at, {.what = EventKind::kAlarm, .detail = number});
}

std::optional<std::uint32_t> SimulatedLab::step() {
  Event event = queue_.take();
  now_ = queue_.now();
  switch (event.what) {
    case EventKind::kArrival:
      arrive(std::move(event));
      break;
    case EventKind::kDiscovery:
      discover(event);
      break;
    case EventKind::kWakeUp: {
      ProcessSlot* const slot = slot_of(event.node);
      if (slot && !slot->is_frozen && slot->generation == event.generation) iterate(*slot);
      break;
    }
    case EventKind::kStart:
      // A process that was killed before its first start is started at the end of that fault.
      if (!slots_[event.detail].is_killed) start(slots_[event.detail]);
      break;
    case EventKind::kAlarm:
      return event.detail;
  }
  return std::nullopt;
}

bool SimulatedLab::has_ended() const {
  return std::ranges::all_of(slots_, [](const ProcessSlot& slot) {
    return !slot.process && !slot.is_killed && slot.exit_code;
  });
}

// --- iterations -----------------------------------------------------------------------------------
// --------------------------------------------------------------------------------------

void SimulatedLab::start(ProcessSlot& slot) {
  if (slot.process) return;
  slot.node = network_.join(factory_.description(slot.key));
  by_node_.push_back(static_cast<std::size_t>(&slot - slots_.data()));
  slot.is_killed = false;
  slot.planned_iteration = kNever;
  on_change(slot);
  const ProcessPlace place{.node = slot.node,
                           .network = &network_,
                           .observer = observer_,
                           .run_clock = &slot.run_clock,
                           .wall_clock = &slot.wall_clock,
                           .now = &now_,
                           .is_logical = settings_.is_logical};
  slot.process = factory_.make(slot.key, place, pose_of(slot.key.vehicle));
  plan_iteration(slot);
}

/// When the process has its next iteration, if that is earlier than what was planned.
void SimulatedLab::plan_iteration(ProcessSlot& slot) {
  if (!slot.process || slot.is_frozen) return;
  const Nanoseconds next = slot.process->next_iteration();
  if (next == kNever) return;
  const Nanoseconds reaction =
      kLeastReaction +
      mixed(settings_.seed ^ slot.node, slot.num_plans++) % (kMostReaction - kLeastReaction);
  const Nanoseconds at = std::max(next, now_) + reaction;
  if (at >= slot.planned_iteration) return;
  slot.planned_iteration = at;
  queue_.add(at, {.what = EventKind::kWakeUp, .node = slot.node, .generation = ++slot.generation});
}

void SimulatedLab::iterate(ProcessSlot& slot) {
  slot.planned_iteration = kNever;
  ++slot.num_iterations;
  slot.process->iterate();
  slot.exit_code = slot.process->exit_code();
  if (!slot.exit_code) return plan_iteration(slot);
  network_.leave(slot.node);
  slot.process.reset();
  on_change(slot);
}

ProcessSlot* SimulatedLab::slot_of(NodeId node) {
  ProcessSlot& slot = slots_[by_node_[node]];
  return slot.process && slot.node == node ? &slot : nullptr;
}

void SimulatedLab::arrive(Event event) {
  const auto arrival = network_.arrive(std::move(event));
  if (!arrival) return;
  ProcessSlot* const slot = slot_of(arrival->node);
  if (!slot) return;
  if (slot->is_frozen) {
    slot->unread.emplace_back(arrival->topic, arrival->message);
    return;
  }
  slot->process->receive(arrival->topic, *arrival->message);
  plan_iteration(*slot);
}

void SimulatedLab::discover(const Event& event) {
  if (!network_.discover(event)) return;
  ProcessSlot* const slot = slot_of(event.node);
  if (!slot) return;
  slot->process->presence_changed();
  plan_iteration(*slot);
}

// --- faults -------------------------------------------------------------------------------------

void SimulatedLab::kill(ProcessSlot& slot) {
  if (slot.exit_code) return;
  slot.is_killed = true;
  slot.is_frozen = false;
  slot.unread.clear();
  if (!slot.process) return;
  slot.process.reset();
  network_.crash(slot.node);
}

void SimulatedLab::restart(ProcessSlot& slot) {
  if (slot.is_killed) start(slot);
}

void SimulatedLab::freeze(ProcessSlot& slot) {
  if (!slot.process) return;
  slot.is_frozen = true;
  slot.planned_iteration = kNever;
  ++slot.generation;
  network_.freeze(slot.node);
}

void SimulatedLab::resume(ProcessSlot& slot) {
  if (!slot.process || !slot.is_frozen) return;
  slot.is_frozen = false;
  for (const auto& [topic, message] : std::exchange(slot.unread, {})) {
    slot.process->receive(topic, *message);
  }
  network_.resume(slot.node);
  plan_iteration(slot);
}

void SimulatedLab::interrupt(ProcessSlot& slot) {
  if (!slot.process) return;
  slot.process->stop();
  plan_iteration(slot);
}

void SimulatedLab::set_clocks(ProcessSlot& slot, std::int64_t step, std::int64_t drift_ppb) {
  if (step != 0) slot.run_clock.step(now_, step);
  if (drift_ppb != 0) {
    for (SimulatedClock* clock : {&slot.run_clock, &slot.wall_clock}) {
      clock->set_drift(now_, clock->drift_ppb() + drift_ppb);
    }
  }
  if (!slot.process) return;
  slot.process->clocks_changed();
  plan_iteration(slot);
}

}  // namespace hlc::closed_loop
