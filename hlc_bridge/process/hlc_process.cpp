#include "hlc_bridge/process/hlc_process.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <thread>
#include <utility>

#include "hlc_bridge/hlc/command.hpp"
#include "hlc_bridge/hlc/observation.hpp"
#include "hlc_bridge/hlc/placement_line.hpp"
#include "hlc_bridge/messages/exit_codes.hpp"
#include "hlc_bridge/messages/node_names.hpp"
#include "hlc_bridge/messages/time_grid.hpp"
#include "hlc_bridge/time/precedence.hpp"
#include "hlc_bridge/time/real_timer.hpp"
#include "hlc_bridge/time/resident_memory.hpp"
#include "hlc_bridge/time/thread_clock.hpp"
#include "hlc_bridge/view/lab_map.hpp"

namespace hlc {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kReadyRepeat{500};
constexpr std::chrono::seconds kStopRequestWait{1};  // for a lab control that is to hear it
constexpr std::chrono::seconds kTwinStays{4};        // longer than a dead one's lease
constexpr std::chrono::seconds kTwinStaysInLogicalTime{12};
constexpr Nanoseconds kLateBegin = 2;     // steps after the trigger's time
constexpr Nanoseconds kDrawnPeriods = 3;  // how long a step's drawings stay on the map
/// For a step's messages, problems and plans.
constexpr std::size_t kHeapReserve = std::size_t{4} << 20;

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
      lab_(on_domain(options_.domains.lab, DomainRole::kLab), [this] { signal_.notify(); }),
      local_(on_domain(options_.domains.local, DomainRole::kLocal), [this] { signal_.notify(); }),
      controllers_(on_domain(options_.domains.controller, DomainRole::kController),
                   [this] { signal_.notify(); }),
      commands_(local_, options_.logical_time, [this] { signal_.notify(); }),
      ready_writer_(local_, topics::ready_status()),
      report_writer_(controllers_, topics::report()),
      drawing_writer_(lab_, topics::visualization()),
      stop_request_writer_(lab_, topics::stop_request()),
      lab_log_(lab_, options_.node_id),
      automaton_answer_writer_(controllers_, topics::automaton_answer()),
      choice_(core_.controller(), options_.reconfiguration),
      preparation_(request_base(), {core_.controller().subgraph().shared_automaton(),
                                    options_.configuration, core_.controller().options().lab}),
      exchange_(vehicle_, controllers_, signal_, options_.logical_time, options_.node_id,
                [this] { return stop_; }),
      automaton_request_reader_(controllers_, topics::automaton_request(),
                                [this](const AutomatonRequest& request) {
                                  if (request.vehicle == vehicle_) preparation_.ask(request);
                                }),
      run_state_reader_(controllers_, topics::run_state(),
                        [this](const RunState& state) {
                          signal_.post([&] {
                            drive_out_ |= state.phase == RunPhase::kDriveOut;
                            if (!start_ && state.start != 0) start_ = state.start;
                          });
                        }),
      trigger_reader_(local_, topics::system_trigger(),
                      [this](const SystemTrigger& trigger) {
                        if (trigger.next_start == kStopSymbol) return take_stop_symbol();
                        signal_.post([&] {
                          if (!start_) start_ = trigger.next_start;
                        });
                      }),
      list_reader_(local_, topics::vehicle_state_list(), [this](const VehicleStateList& list) {
        signal_.post([&] { lists_.push_back(list); });
      }) {
  check_plan_fits_commands();
  if (options_.logical_time) return;  // 50 triggers a second and no car that a stop could save
  lab_stop_reader_.emplace(lab_, topics::system_trigger(), [this](const SystemTrigger& trigger) {
    if (trigger.next_start == kStopSymbol) take_stop_symbol();
  });
}

ParticipantOptions HlcProcess::on_domain(std::optional<int> domain, DomainRole role) {
  return {.name = controller_name(vehicle_.value),
          .domain_id = domain.value(),
          .role = role,
          .transport = options_.transport,
          .logical_time = options_.logical_time,
          .discovery_server = role == DomainRole::kLab ? options_.discovery_server : std::nullopt,
          .peers = role == DomainRole::kController ? options_.controller_peers
                                                   : std::vector<std::string>{},
          .version = options_.version,
          .on_loss = [this](const std::string& line) {
            signal_.post([&] { losses_.push_back(line); });
          }};
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

void HlcProcess::take_stop_symbol() {
  signal_.post([this] { stop_ = stop_symbol_ = true; });
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
  return !active_.empty() && commands_.matched() > 0 && exchange_.deaf(peer_names()).empty();
}

/// Into an experiment that runs a controller comes back alone: whoever is not there is missing, as
/// in any step.
void HlcProcess::note_who_is_there() {
  had_middleware_ = had_middleware_ || commands_.matched() > 0;
  const bool joins = !options_.logical_time && !active_.empty() && commands_.matched() > 0 &&
                     signal_.locked([this] { return start_.has_value(); });
  if (is_ready_ || has_twin() || !(joins || has_everybody())) return;
  is_ready_ = true;
  exchange_.forget_twin();
}

bool HlcProcess::has_twin() const { return lab_.is_alive(controller_name(vehicle_.value)); }

/// The one that was ready first stays. Where both are (one was cut off or stopped for longer than
/// its lease, and has been replaced), the vehicle would follow now the one, now the other, and
/// nobody could reckon with what it drives: each leaves as soon as it hears the other.
bool HlcProcess::yields_to_twin() const {
  return is_ready_ ? exchange_.has_heard_twin() : has_twin();
}

/// Others on the local domain may come and go: in the lab it holds all controllers of a computer.
bool HlcProcess::has_lost_middleware() const {
  return local_.is_lost(middleware_) || (had_middleware_ && commands_.matched() == 0);
}

/// True when there is no use in waiting for it to be started again. A lab control that is gone,
/// too, is no reason: to a process that got no processor for the time of a lease all others are
/// gone.
bool HlcProcess::is_middleware_gone_for_good() {
  if (!has_lost_middleware()) {
    if (middleware_lost_at_) spdlog::info("{}: {} is back", options_.node_id, middleware_);
    middleware_lost_at_.reset();
    return false;
  }
  if (!middleware_lost_at_) {
    spdlog::error("{}: {} is gone; nothing reaches the vehicle any more", options_.node_id,
                  middleware_);
    middleware_lost_at_ = Clock::now();
  }
  return options_.logical_time || signal_.locked([this] { return drive_out_; }) ||
         Clock::now() > *middleware_lost_at_ + options_.startup_timeout;
}

std::string HlcProcess::who_is_missing() const {
  if (has_twin()) return "another " + controller_name(vehicle_.value) + " is there";
  if (active_.empty()) return "no state list came from the middleware";
  std::set<std::string> names;
  if (commands_.matched() == 0) names.insert("the middleware's reader of commands");
  names.merge(exchange_.deaf(peer_names()));
  return "not there: " + joined(names);
}

/// In logical time the first list is answered only when everybody is there, since nobody waits for
/// messages that were sent before.
bool HlcProcess::wait_for_everybody() {
  const auto is_settled = [this] { return stop_ || is_ready_ || (!has_twin() && has_everybody()); };
  const bool settled = signal_.repeat_until(started_at_ + options_.startup_timeout, kReadyRepeat,
                                            is_settled, [this] { tell_whom_it_waits_for(); });
  note_who_is_there();
  return settled;
}

void HlcProcess::tell_whom_it_waits_for() {
  if (!is_ready_ && wait_notice_.is_due()) {
    spdlog::info("{}: waits: {}", options_.node_id, who_is_missing());
  }
  // In logical time lists come as fast as everybody is done, or as somebody presses a button.
  if (is_ready_ && !options_.logical_time && list_notice_.is_due()) {
    const std::chrono::duration<double> silence = Clock::now() - last_list_at_;
    spdlog::warn("{}: waits: {} has sent no state list for {:.0f} s", options_.node_id, middleware_,
                 silence.count());
  }
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

void HlcProcess::tell_losses() {
  for (const std::string& line : signal_.locked([this] { return std::exchange(losses_, {}); })) {
    spdlog::warn("{}: {}", options_.node_id, line);
  }
}

void HlcProcess::watch_lab_control() {
  switch (lab_control_.look(lab_.is_lost(kLabControlName), stop_request_writer_.matched(),
                            Clock::now())) {
    case LabControlWatch::Change::kNone:
      return;
    case LabControlWatch::Change::kLost:
      spdlog::error("{}: {} is gone; the running plan is driven to its end", options_.node_id,
                    kLabControlName);
      return;
    case LabControlWatch::Change::kBack:
      spdlog::info("{}: {} is back; planning goes on", options_.node_id, kLabControlName);
      return;
  }
}

bool HlcProcess::drives_out() const {
  return lab_control_.is_lost() || signal_.locked([this] { return drive_out_; });
}

HlcProcess::Event HlcProcess::wait_for_event() {
  while (true) {
    if (signal_.locked([this] { return stop_symbol_; })) commands_.drop_copy();
    commands_.send_copy_when_due();
    tell_losses();
    watch_lab_control();
    note_who_is_there();
    send_ready_now_and_then();
    tell_whom_it_waits_for();
    Clock::time_point wake = Clock::now() + kReadyRepeat;
    wake = std::min(wake, commands_.copy_due().value_or(wake));
    const bool happened = signal_.wait_until(wake, [this] {
      const bool is_lost = has_lost_middleware();
      return stop_ || !lists_.empty() || is_lost != middleware_lost_at_.has_value() ||
             (is_lost && drive_out_);
    });
    if (signal_.locked([this] { return stop_; })) return Event::kStop;
    if (is_middleware_gone_for_good()) return Event::kMiddlewareLost;
    if (yields_to_twin() &&
        Clock::now() >
            started_at_ + (options_.logical_time ? kTwinStaysInLogicalTime : kTwinStays)) {
      return Event::kTwin;
    }
    if (lab_control_.is_lost_for_good(Clock::now())) return Event::kLabControlLost;
    if (happened && signal_.locked([this] { return !lists_.empty(); })) return Event::kList;
    if (!is_ready_ && Clock::now() > started_at_ + options_.startup_timeout) return Event::kTimeout;
  }
}

void HlcProcess::prepare_thread() const {
  make_code_resident();
  reserve_heap(kHeapReserve);
  if (options_.thread_priority > 0 && !take_precedence(options_.thread_priority)) {
    spdlog::info("{}: no real-time priority (ulimit -r): others may interrupt a plan",
                 options_.node_id);
  }
  if (options_.core && !stay_on_core(*options_.core)) {
    spdlog::warn("{}: --core = {}: this machine has no such core for it, allowed 0 ... {}",
                 options_.node_id, *options_.core, std::thread::hardware_concurrency() - 1);
  }
}

int HlcProcess::run() {
  prepare_thread();  // not earlier: only this thread plans
  const int code = drive();
  leave_vehicle_its_plan();
  tell_losses();
  if (code != kExitGood || after_step_fault_.empty()) return code;
  // Once more, as its last word.
  spdlog::error("{}: {}", options_.node_id, after_step_fault_);
  return kExitNotWritten;
}

/// The copy of its last command may still wait.
void HlcProcess::leave_vehicle_its_plan() {
  const std::optional<Clock::time_point> due = commands_.copy_due();
  if (!due || signal_.wait_until(*due, [this] { return stop_symbol_; })) return;
  commands_.send_copy_when_due();
}

int HlcProcess::drive() {
  while (true) {
    switch (wait_for_event()) {
      case Event::kStop:
        return kExitGood;
      case Event::kMiddlewareLost:
        return is_ready_ ? kExitDied : kExitMissing;
      case Event::kTwin:
        spdlog::error("{}: another {} is there; a vehicle follows one: end it first",
                      options_.node_id, controller_name(vehicle_.value));
        return kExitBadInput;
      case Event::kLabControlLost:
        return kExitDied;
      case Event::kTimeout:
        spdlog::error("{}: {} within {} s", options_.node_id, who_is_missing(),
                      options_.startup_timeout.count());
        return kExitMissing;
      case Event::kList:
        last_list_at_ = Clock::now();
        list_notice_ = WaitNotice{last_list_at_};
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
  exchange_.begin(observation->step);
  const std::optional<Nanoseconds> trigger = signal_.locked([this] { return start_; });
  ReportRecord record;
  const bool had_begun = core_.has_begun();
  const bool is_running =
      is_ready_ && core_.begins(list, *observation, options_.logical_time, trigger);
  if (is_running) note_start(observation->step, trigger);
  const Nanoseconds reconfiguring_from = thread_time_now();
  reconfigure(list, observation->step);
  const Nanoseconds reconfiguring_ns = thread_time_now() - reconfiguring_from;
  if (is_running) {
    if (!had_begun) tell_begin(list, trigger);
    record = run_step(list, *observation);
    record.planning_ns += reconfiguring_ns;
    tell_if_stuck(record.report);
  } else if (options_.logical_time || (!yields_to_twin() && core_.may_stand_by(*observation))) {
    record.report = core_.controller().stand_by(*observation);
    tell_placement();
    send_answer(list, record.report);
  } else {
    return;
  }
  report_writer_.write(record);
  draw(record.report, list);
  if (core_.has_begun()) look_back();
  if (is_running) look_ahead(list, record.report);
}

RequestBase HlcProcess::request_base() const {
  const ControllerOptions& options = core_.controller().options();
  return {.subgraph = choice_.base(),
          .limits_mps = choice_.limits_mps(),
          .horizon_steps = options.horizon_steps,
          .search = options.search};
}

/// In real time the trigger's, the same for all: who comes back later counts from there, too.
void HlcProcess::note_start(StepIndex step, std::optional<Nanoseconds> trigger) {
  if (first_step_) return;
  first_step_ = step;
  if (options_.logical_time || !trigger) return;
  first_step_ = std::min(step, StepIndex{(*trigger + step_ns_ - 1) / step_ns_});
}

void HlcProcess::reconfigure(const VehicleStateList& list, StepIndex step) {
  if (options_.logical_time) preparation_.wait();
  for (PreparedRequest& prepared : preparation_.take()) {
    for (const AutomatonAnswer& answer : reconfiguration_.take(std::move(prepared), step)) {
      tell(answer);
    }
  }
  std::optional<AutomatonAnswer> answer = reconfiguration_.begin_step(choice_, step, list.t_now);
  Controller& controller = core_.controller();
  const bool has_switched =
      choice_.begin_step(controller, step, first_step_, battery_voltage_v(list, vehicle_));
  if (answer) {
    answer->text = controller.subgraph().spec().name;
    tell(*answer);
  } else if (has_switched) {
    spdlog::info("{}: plans on subgraph {} from step {} on", options_.node_id,
                 controller.subgraph().spec().name, step.value);
  }
}

/// The copy of the command goes first: without it a controller that died meanwhile would leave its
/// vehicle half a plan.
void HlcProcess::look_ahead(const VehicleStateList& list, const Report& report) {
  if (choice_.looks_ahead()) commands_.send_copy_after_its_pause();
  const bool has_time = options_.logical_time ||
                        real_time_now() < deadline_in_step(list, options_.deadlines.look_ahead);
  choice_.end_step(core_.controller(), report, has_time);
}

void HlcProcess::tell(const AutomatonAnswer& answer) {
  automaton_answer_writer_.write(answer);
  switch (answer.outcome) {
    case RequestOutcome::kAccepted:
      return;
    case RequestOutcome::kInForce:
      spdlog::info("{}: plans on subgraph {} from step {} on", options_.node_id, answer.text,
                   answer.step.value);
      return;
    case RequestOutcome::kRefused:
    case RequestOutcome::kStale:
      spdlog::warn("{}: a request for another subgraph is refused: {}", options_.node_id,
                   answer.text);
      return;
  }
}

/// Only who drives tells its traffic: the trigger has been, and is not repeated. Who takes no part,
/// or speaks of another time, says nothing about this experiment.
void HlcProcess::join_if_others_drive(const Observation& observation) {
  if (signal_.locked([this] { return start_.has_value(); })) return;
  const std::uint64_t now = observation.step.value;
  for (const VehicleId vehicle : others(observation)) {
    const std::optional<StepIndex> told = exchange_.newest_traffic(vehicle);
    if (!told || told->value + 1 < now || told->value > now + 1) continue;
    signal_.locked([&] {
      start_ = told->value * step_ns_;
      joins_ = true;
    });
  }
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

/// A budget once in a run: where one is too small now and then, the table says how often.
void HlcProcess::tell_if_stuck(const Report& report) {
  const bool is_off_route = report.reason == FallbackReason::kOffRoute;
  const bool has_used_up_budget = report.reason == FallbackReason::kBudget;
  if ((is_off_route && !told_off_route_) || (has_used_up_budget && !told_budget_)) {
    spdlog::error("{}: {}", options_.node_id, stuck_line(core_.controller(), report.reason));
  }
  told_off_route_ = is_off_route;
  told_budget_ |= has_used_up_budget;
}

void HlcProcess::look_back() {
  if (!options_.after_step) return;
  try {
    options_.after_step(core_.controller());
  } catch (const std::exception& error) {
    after_step_fault_ = "from step " + std::to_string(core_.controller().last_step().value) +
                        " on nothing is written: " + error.what();
    spdlog::error("{}: {}", options_.node_id, after_step_fault_);
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

ReportRecord HlcProcess::run_step(const VehicleStateList& list, const Observation& observation) {
  ReportRecord record;
  Controller& controller = core_.controller();
  controller.set_drives_out(drives_out());

  const auto until = [&list](double share) { return deadline_in_step(list, share); };
  const StepDeadlines& deadlines = options_.deadlines;

  exchange_.say(controller.observe(observation));
  static_cast<void>(controller.warm_up());  // while the others' messages are on their way
  exchange_.wait_for<Traffic>(others(observation), until(deadlines.traffic));
  controller.couple(exchange_.heard<Traffic>());

  exchange_.wait_for<Prediction>(controller.predecessors(), until(deadlines.predecessors));
  const std::vector<Prediction> heard = exchange_.heard<Prediction>();
  const Nanoseconds planning_from = thread_time_now();
  const Prediction prediction = controller.plan(heard);
  record.planning_ns = thread_time_now() - planning_from;
  exchange_.say(prediction);

  const bool strict = controller.options().settle_rule == SettleRule::kStrict;
  if (strict) {
    exchange_.wait_for<Prediction>(controller.coupled(), until(deadlines.settle));
  } else {
    exchange_.say(controller.vote());
    exchange_.wait_for<Outcome>(controller.component(), until(deadlines.settle));
  }
  const std::vector<Prediction> predictions = exchange_.heard<Prediction>();
  const std::vector<Outcome> outcomes = exchange_.heard<Outcome>();
  const Nanoseconds deadline = until(deadlines.command);
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
  const AnswerToList answer = core_.answer(list);
  commands_.send(answer);
  if (!answer.fault.empty() && answer.fault != last_fault_) {
    spdlog::error("{}: the command of step {} is not sent, the last good one is: {}",
                  options_.node_id, step_of(list).value, answer.fault);
  }
  last_fault_ = answer.fault;
  report = with_answer(std::move(report), answer);
}

}  // namespace hlc
