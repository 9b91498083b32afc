#include "hlc_bridge/hlc/hlc_process.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "hlc_bridge/core/command.hpp"
#include "hlc_bridge/core/exit_codes.hpp"
#include "hlc_bridge/core/node_names.hpp"
#include "hlc_bridge/core/observation.hpp"
#include "hlc_bridge/core/placement_line.hpp"
#include "hlc_bridge/core/time_grid.hpp"
#include "hlc_bridge/time/precedence.hpp"
#include "hlc_bridge/time/real_timer.hpp"
#include "hlc_bridge/view/lab_map.hpp"

namespace hlc {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kReadyRepeat{500};
constexpr std::chrono::nanoseconds kSilence{kMessageTimeout};
/// On the lab's transport the reader of the middleware keeps one sample. Short: who dies in it
/// leaves a car that drops its plan after kCommandLifetime and brakes.
constexpr std::chrono::milliseconds kCopyPause{5};
constexpr std::chrono::seconds kStopRequestWait{1};  // for a lab control that is to hear it
constexpr Nanoseconds kLateBegin = 2;                // steps after the trigger's time
constexpr Nanoseconds kDrawnPeriods = 3;             // how long a step's drawings stay on the map

ParticipantOptions on_domain(const HlcProcessOptions& options, VehicleId vehicle,
                             std::optional<int> domain, DomainRole role) {
  return {.name = controller_name(vehicle.value),
          .domain_id = domain.value(),
          .role = role,
          .transport = options.transport,
          .logical_time = options.logical_time,
          .discovery_server = role == DomainRole::kLab ? options.discovery_server : std::nullopt,
          .peers = role == DomainRole::kController ? options.controller_peers
                                                   : std::vector<std::string>{}};
}

std::string joined(const std::set<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

}  // namespace

HlcProcess::HlcProcess(HlcProcessOptions options, std::unique_ptr<Controller> controller)
    : options_(std::move(options)),
      core_(std::move(controller)),
      vehicle_(core_.controller().options().vehicle),
      middleware_(middleware_name(vehicle_.value)),
      step_ns_(static_cast<Nanoseconds>(
          std::llround(1e9 * core_.controller().subgraph().automaton().step_s))),
      started_at_(Clock::now()),
      lab_(on_domain(options_, vehicle_, options_.domains.lab, DomainRole::kLab),
           [this] { signal_.notify(); }),
      local_(on_domain(options_, vehicle_, options_.domains.local, DomainRole::kLocal),
             [this] { signal_.notify(); }),
      controllers_(
          on_domain(options_, vehicle_, options_.domains.controller, DomainRole::kController),
          [this] { signal_.notify(); }),
      command_writer_(local_, topics::command(), [this] { signal_.notify(); }),
      ready_writer_(local_, topics::ready_status()),
      traffic_writer_(controllers_, topics::traffic(), [this] { signal_.notify(); }),
      prediction_writer_(controllers_, topics::prediction(), [this] { signal_.notify(); }),
      outcome_writer_(controllers_, topics::outcome(), [this] { signal_.notify(); }),
      report_writer_(controllers_, topics::report()),
      drawing_writer_(lab_, topics::visualization()),
      stop_request_writer_(lab_, topics::stop_request()),
      lab_log_(lab_, options_.node_id),
      traffic_reader_(controllers_, topics::traffic(),
                      [this](const Traffic& message) {
                        signal_.post([&] {
                          traffic_inbox_.put(message);
                          given_up_.erase(message.vehicle);
                          if (!start_) last_traffic_[message.vehicle] = message.step;
                        });
                      }),
      prediction_reader_(controllers_, topics::prediction(),
                         [this](const Prediction& message) {
                           signal_.post([&] { prediction_inbox_.put(message); });
                         }),
      outcome_reader_(
          controllers_, topics::outcome(),
          [this](const Outcome& message) { signal_.post([&] { outcome_inbox_.put(message); }); }),
      run_state_reader_(controllers_, topics::run_state(),
                        [this](const RunState& state) {
                          signal_.post([&] {
                            drive_out_ |= state.phase == RunPhase::kDriveOut;
                            if (!start_ && state.start != 0) start_ = state.start;
                          });
                        }),
      trigger_reader_(local_, topics::system_trigger(),
                      [this](const SystemTrigger& trigger) {
                        signal_.post([&] {
                          if (trigger.next_start == kStopSymbol) {
                            stop_ = true;
                          } else if (!start_) {
                            start_ = trigger.next_start;
                          }
                        });
                      }),
      list_reader_(local_, topics::vehicle_state_list(), [this](const VehicleStateList& list) {
        signal_.post([&] { lists_.push_back(list); });
      }) {
  check_plan_fits_commands();
}

void HlcProcess::check_plan_fits_commands() const {
  const ControllerOptions& options = core_.controller().options();
  const double step_s = core_.controller().subgraph().automaton().step_s;
  const double drivable_s = 1e-9 * static_cast<double>(kCopyDelay + kCommandLifetime);
  if (static_cast<double>(options.horizon_steps + 1) * step_s > drivable_s + 1e-9) {
    throw std::invalid_argument("horizon_steps = " + std::to_string(options.horizon_steps) +
                                ", allowed at most " +
                                std::to_string(std::lround(drivable_s / step_s) - 1) +
                                ": a vehicle drops its command before a longer plan has ended");
  }
}

void HlcProcess::stop() {
  signal_.post([this] { stop_ = true; });
}

std::vector<VehicleId> HlcProcess::others(const Observation& observation) const {
  std::vector<VehicleId> result = observation.active;
  std::erase(result, vehicle_);
  return result;
}

std::set<std::string> HlcProcess::peer_names() const {
  std::set<std::string> names;
  for (const VehicleId vehicle : active_) {
    if (vehicle != vehicle_) names.insert(controller_name(vehicle.value));
  }
  return names;
}

/// Nothing that this process says may be lost: every writer has its readers matched.
bool HlcProcess::has_everybody() const {
  if (active_.empty()) return false;
  const std::set<std::string> peers = peer_names();
  const auto reaches = [&peers](const auto& writer) {
    return std::ranges::includes(writer.matched_names(), peers);
  };
  return command_writer_.matched() > 0 && reaches(traffic_writer_) && reaches(prediction_writer_) &&
         reaches(outcome_writer_);
}

/// Into an experiment that runs a controller comes back alone: whoever is not there is missing, as
/// in any step.
void HlcProcess::note_who_is_there() {
  had_middleware_ = had_middleware_ || command_writer_.matched() > 0;
  const bool joins = !options_.logical_time && !active_.empty() && command_writer_.matched() > 0 &&
                     signal_.locked([this] { return start_.has_value(); });
  is_ready_ = is_ready_ || joins || has_everybody();
}

/// Others on the local domain may come and go: in the lab it holds all controllers of a computer.
bool HlcProcess::has_lost_middleware() const {
  return local_.is_lost(middleware_) || (had_middleware_ && command_writer_.matched() == 0);
}

std::string HlcProcess::who_is_missing() const {
  if (active_.empty()) return "no state list came from the middleware";
  std::set<std::string> names;
  if (command_writer_.matched() == 0) names.insert("the middleware's reader of commands");
  const std::set<std::string> heard = outcome_writer_.matched_names();
  for (const std::string& name : peer_names()) {
    if (!heard.contains(name)) names.insert(name);
  }
  return "not there: " + joined(names);
}

/// In logical time the first list is answered only when everybody is there, since nobody waits for
/// messages that were sent before.
bool HlcProcess::wait_for_everybody() {
  const auto is_settled = [this] { return stop_ || is_ready_ || has_everybody(); };
  const bool settled = signal_.wait_until(started_at_ + options_.startup_timeout, is_settled);
  note_who_is_there();
  return settled;
}

void HlcProcess::send_ready_now_and_then() {
  const bool triggered = signal_.locked([this] { return start_.has_value(); });
  const Controller& controller = core_.controller();
  const bool is_misplaced = controller.placement() && !controller.fits_route();
  const bool is_unseen = !options_.logical_time && !controller.placement();
  if (!is_ready_ || is_misplaced || is_unseen || triggered || Clock::now() < next_ready_at_) {
    return;
  }
  if (next_ready_at_ == Clock::time_point{} && !options_.logical_time) {
    spdlog::info("{}: ready, waits for a trigger", options_.node_id);
  }
  ready_writer_.write({.source_id = controller_ready_id(vehicle_.value)});
  next_ready_at_ = Clock::now() + kReadyRepeat;
}

void HlcProcess::send_copy_when_due() {
  if (signal_.locked([this] { return stop_; })) copy_due_.reset();
  if (!copy_due_ || Clock::now() < copy_due_->first) return;
  command_writer_.write(copy_due_->second);
  copy_due_.reset();
}

/// Without the lab control nobody can stop the cars: they drive out their plans.
void HlcProcess::watch_lab_control() {
  if (lab_control_lost_at_ || !lab_.is_lost(kLabControlName)) return;
  spdlog::error("{}: {} is gone; the running plan is driven to its end", options_.node_id,
                kLabControlName);
  lab_control_lost_at_ = Clock::now();
  signal_.post([this] { drive_out_ = true; });
}

HlcProcess::Event HlcProcess::wait_for_event() {
  while (true) {
    send_copy_when_due();
    watch_lab_control();
    note_who_is_there();
    send_ready_now_and_then();
    Clock::time_point wake = Clock::now() + kReadyRepeat;
    if (copy_due_) wake = std::min(wake, copy_due_->first);
    const bool happened = signal_.wait_until(
        wake, [this] { return stop_ || !lists_.empty() || has_lost_middleware(); });
    if (signal_.locked([this] { return stop_; })) return Event::kStop;
    if (has_lost_middleware()) return Event::kMiddlewareLost;
    if (lab_control_lost_at_ &&
        Clock::now() > *lab_control_lost_at_ + std::chrono::nanoseconds(kControllerStays)) {
      return Event::kLabControlLost;
    }
    if (happened && signal_.locked([this] { return !lists_.empty(); })) return Event::kList;
    if (!is_ready_ && Clock::now() > started_at_ + options_.startup_timeout) return Event::kTimeout;
  }
}

void HlcProcess::prepare_thread() const {
  if (options_.thread_priority > 0 && !take_precedence(options_.thread_priority)) {
    spdlog::info("{}: no real-time priority (ulimit -r): others may interrupt a plan",
                 options_.node_id);
  }
  if (options_.core && !stay_on_core(*options_.core)) {
    spdlog::warn("{}: --core = {}: this machine has no such core for it", options_.node_id,
                 *options_.core);
  }
}

int HlcProcess::run() {
  prepare_thread();  // not earlier: only this thread plans
  while (true) {
    switch (wait_for_event()) {
      case Event::kStop:
        return kExitGood;
      case Event::kMiddlewareLost:
        spdlog::error("{}: {} is gone; nothing reaches the vehicle any more", options_.node_id,
                      middleware_);
        return is_ready_ ? kExitDied : kExitMissing;
      case Event::kLabControlLost:
        return kExitDied;
      case Event::kTimeout:
        spdlog::error("{}: {} within {} s", options_.node_id, who_is_missing(),
                      options_.startup_timeout.count());
        return kExitMissing;
      case Event::kList:
        break;
    }
    const VehicleStateList list = signal_.locked([this] {
      // In real time only the newest list is worth an answer. The others' steps stay without a
      // report, and the summary counts each as a deadline missed.
      if (!options_.logical_time) lists_.erase(lists_.begin(), lists_.end() - 1);
      VehicleStateList next = std::move(lists_.front());
      lists_.pop_front();
      return next;
    });
    answer(list);
    if (has_bad_period_) return kExitBadInput;
  }
}

void HlcProcess::answer(const VehicleStateList& list) {
  if (const std::string problem = core_.problem_with(list); !problem.empty()) {
    spdlog::error("{}: {}", options_.node_id, problem);
    has_bad_period_ = true;
    if (stop_request_writer_.wait_for_matched(1, Clock::now() + kStopRequestWait)) {
      stop_request_writer_.write({.vehicle_id = vehicle_.value});
    }
    return;
  }
  std::optional<Observation> observation = core_.observe(list);
  if (!observation) return;  // heard twice
  observation->present = present(observation->active);
  active_ = observation->active;
  if (options_.logical_time && !wait_for_everybody()) return;

  if (!core_.has_begun()) {
    core_.note(list, *observation);
    join_if_others_drive(*observation);
  }
  signal_.locked([&] {
    traffic_inbox_.begin(observation->step);
    prediction_inbox_.begin(observation->step);
    outcome_inbox_.begin(observation->step);
  });
  const std::optional<Nanoseconds> trigger = signal_.locked([this] { return start_; });
  ReportRecord record;
  const bool had_begun = core_.has_begun();
  if (is_ready_ && core_.begins(list, *observation, options_.logical_time, trigger)) {
    if (!had_begun) tell_begin(list, trigger);
    record = run_step(list, *observation);
    tell_if_stuck(record.report);
  } else if (options_.logical_time || core_.may_stand_by(*observation)) {
    record.report = core_.controller().stand_by(*observation);
    tell_placement();
    send_answer(list, record.report);
  } else {
    return;
  }
  report_writer_.write(record);
  draw(record.report, list);
  if (core_.has_begun()) look_back();
}

/// Only who drives tells its traffic: the trigger has been, and is not repeated. Who takes no part,
/// or speaks of another time, says nothing about this experiment.
void HlcProcess::join_if_others_drive(const Observation& observation) {
  const std::uint64_t now = observation.step.value;
  signal_.locked([&] {
    if (start_) return;
    for (const VehicleId vehicle : others(observation)) {
      const auto told = last_traffic_.find(vehicle);
      if (told == last_traffic_.end() || told->second.value + 1 < now ||
          told->second.value > now + 1) {
        continue;
      }
      start_ = told->second.value * step_ns_;
      joins_ = true;
    }
  });
}

/// Once it stands where it fits, and once whenever that changes.
void HlcProcess::tell_placement() {
  const Controller& controller = core_.controller();
  if (!controller.placement() || told_placed_ == controller.fits_route()) return;
  told_placed_ = controller.fits_route();
  const std::string line = placement_line(controller);
  if (*told_placed_) {
    spdlog::info("{}: {}", options_.node_id, line);
  } else {
    spdlog::error("{}: {}", options_.node_id, line);
  }
}

void HlcProcess::tell_begin(const VehicleStateList& list,
                            std::optional<Nanoseconds> trigger) const {
  const bool joins = signal_.locked([this] { return joins_; });
  if (options_.logical_time || (!joins && list.t_now < *trigger + kLateBegin * step_ns_)) return;
  spdlog::info("{}: joins the experiment, which runs", options_.node_id);
}

void HlcProcess::tell_if_stuck(const Report& report) {
  const bool is_stuck = report.reason == FallbackReason::kOffRoute;
  if (is_stuck && !told_stuck_) {
    spdlog::error("{}: {}", options_.node_id, stuck_line(core_.controller()));
  }
  told_stuck_ = is_stuck;
}

void HlcProcess::look_back() {
  if (!options_.after_step) return;
  try {
    options_.after_step(core_.controller());
  } catch (const std::exception& error) {
    spdlog::error("{}: {}; nothing more is written", options_.node_id, error.what());
    options_.after_step = nullptr;
  }
}

void HlcProcess::draw(const Report& report, const VehicleStateList& list) {
  if (drawing_writer_.matched() == 0) return;
  for (const Visualization& drawing :
       lab_map(core_.controller(), report, kDrawnPeriods * list.period_ms * 1'000'000)) {
    drawing_writer_.write(drawing);
  }
}

/// The controllers' network alone may have failed: who is on the lab's still commands its vehicle.
std::vector<VehicleId> HlcProcess::present(std::vector<VehicleId> vehicles) const {
  std::erase_if(vehicles, [this](VehicleId vehicle) {
    const std::string name = controller_name(vehicle.value);
    return !lab_.is_alive(name) && !controllers_.is_alive(name);
  });
  return vehicles;
}

bool HlcProcess::is_awaited(VehicleId vehicle) const {
  return !given_up_.contains(vehicle) && controllers_.is_alive(controller_name(vehicle.value));
}

template <class Message>
void HlcProcess::wait_for(const StepMailbox<Message>& mailbox, const std::vector<VehicleId>& from,
                          const VehicleStateList& list, double deadline_share) {
  const auto all_in = [&] {
    return stop_ || std::ranges::all_of(from, [&](VehicleId vehicle) {
             return mailbox.holds(vehicle) || !is_awaited(vehicle);
           });
  };
  if (!options_.logical_time) {
    static_cast<void>(
        signal_.wait_until(real_time_point(deadline_in_step(list, deadline_share)), all_in));
    return;
  }
  if (signal_.wait_until(Clock::now() + kSilence, all_in)) return;
  for (const VehicleId vehicle : from) {
    if (signal_.locked([&] { return mailbox.holds(vehicle); })) continue;
    spdlog::warn("{}: {} has said nothing for {} s and is not waited for any more",
                 options_.node_id, controller_name(vehicle.value),
                 kMessageTimeout / kNanosecondsPerSecond);
    signal_.locked([&] { given_up_.insert(vehicle); });
  }
}

ReportRecord HlcProcess::run_step(const VehicleStateList& list, const Observation& observation) {
  ReportRecord record;
  Controller& controller = core_.controller();
  if (signal_.locked([this] { return drive_out_; })) controller.drive_out();

  traffic_writer_.write(controller.observe(observation));
  wait_for(traffic_inbox_, others(observation), list, options_.deadlines.traffic);
  controller.couple(signal_.locked([this] { return traffic_inbox_.all(); }));

  wait_for(prediction_inbox_, controller.predecessors(), list, options_.deadlines.predecessors);
  const std::vector<Prediction> heard = signal_.locked([this] { return prediction_inbox_.all(); });
  const Clock::time_point planning_from = Clock::now();
  const Prediction prediction = controller.plan(heard);
  record.planning_ns =
      static_cast<Nanoseconds>(std::chrono::nanoseconds(Clock::now() - planning_from).count());
  prediction_writer_.write(prediction);

  const bool strict = controller.options().settle_rule == SettleRule::kStrict;
  if (strict) {
    wait_for(prediction_inbox_, controller.coupled(), list, options_.deadlines.settle);
  } else {
    outcome_writer_.write(controller.vote());
    wait_for(outcome_inbox_, controller.component(), list, options_.deadlines.settle);
  }
  const auto [predictions, outcomes] = signal_.locked([this] {
    return std::pair{prediction_inbox_.all(), outcome_inbox_.all()};
  });
  const Nanoseconds deadline = deadline_in_step(list, options_.deadlines.command);
  const Nanoseconds now = options_.logical_time ? list.t_now : real_time_now();
  if (now > deadline) {
    record.deadline_missed = true;
    record.late_ns = now - deadline;
    record.report = controller.give_up(FallbackReason::kLate);
  } else {
    record.report = controller.settle(predictions, outcomes);
  }
  send_answer(list, record.report);
  return record;
}

void HlcProcess::send_answer(const VehicleStateList& list, Report& report) {
  // After the stop symbol the vehicle brakes, and then it listens again: it must hear nothing.
  if (signal_.locked([this] { return stop_; })) return;
  if (copy_due_) command_writer_.write(copy_due_->second);
  copy_due_.reset();
  const AnswerToList answer = core_.answer(list);
  command_writer_.write(answer.command);
  if (!answer.fault.empty() && answer.fault != last_fault_) {
    spdlog::error("{}: the command of step {} is not sent, the last good one is: {}",
                  options_.node_id, step_of(list).value, answer.fault);
  }
  last_fault_ = answer.fault;
  report = with_answer(std::move(report), answer);
  if (!answer.copy) return;
  if (options_.transport == Transport::kLoopback) {
    command_writer_.write(*answer.copy);
  } else if (!options_.logical_time) {
    copy_due_.emplace(Clock::now() + kCopyPause, *answer.copy);
  }
}

}  // namespace hlc
