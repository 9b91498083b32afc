#include "hlc_bridge/hlc/hlc_machine.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "hlc_bridge/hlc/observation.hpp"
#include "hlc_bridge/messages/exit_codes.hpp"
#include "hlc_bridge/messages/node_names.hpp"
#include "hlc_bridge/messages/time_grid.hpp"
#include "planner/controller/command_time.hpp"

namespace hlc::high_level_controller {
namespace {

/// Time for the lab control to receive the stop request.
constexpr Nanoseconds kStopRequestWait = kNanosecondsPerSecond;
constexpr Nanoseconds kDrawnPeriods = 3;  // how long a step's drawings stay on the map
constexpr Nanoseconds kAtOnce = 0;        // a wake-up in the past
/// A middleware waits for the answer to each list, or for its deadline.
constexpr std::size_t kMostLists = 64;

Nanoseconds step_ns(const controller::Controller& controller) {
  return static_cast<Nanoseconds>(std::llround(1e9 * controller.subgraph().automaton().step_s));
}

static_assert(kControllerStays >= 1e9 * controller::kLongestPlan_s);

void check_plan_fits_commands(const controller::Controller& controller) {
  const std::size_t steps = controller.options().horizon_steps;
  const double step_s = controller.subgraph().automaton().step_s;
  if (static_cast<double>(steps + 1) * step_s <= controller::kLongestPlan_s + 1e-9) return;
  throw std::invalid_argument(
      "horizon_steps must be <= " +
      std::to_string(std::lround(std::floor(controller::kLongestPlan_s / step_s + 1e-9)) - 1) +
      ", got " + std::to_string(steps) +
      ": a minimal-risk stop ends before a longer plan has ended");
}

}  // namespace

HlcMachine::HlcMachine(const HlcSettings& settings,
                       std::unique_ptr<controller::Controller> controller)
    : rules_(settings.rules),
      cpu_time_(settings.cpu_time ? settings.cpu_time : [] { return std::uint64_t{}; }),
      core_(std::move(controller)),
      life_(core_.controller().options().vehicle, rules_, settings.startup_timeout),
      start_(core_.controller().options().vehicle, rules_.start, step_ns(core_.controller())),
      step_(core_.controller(), rules_, cpu_time_),
      copies_(rules_.copy),
      subgraphs_(core_.controller(), settings.reconfiguration) {
  check_plan_fits_commands(core_.controller());
}

void HlcMachine::on(Event event) {
  std::visit([this](auto& what) { take(std::move(what)); }, event);
}

void HlcMachine::take(VehicleStateList&& list) {
  lists_.push_back(std::move(list));
  if (lists_.size() > kMostLists) lists_.pop_front();
}

void HlcMachine::take(const SystemTrigger& trigger) {
  if (trigger.next_start != kStopSymbol) return start_.trigger(trigger.next_start);
  ending_.is_asked = true;
  copies_.drop();
}

void HlcMachine::take(const RunState& state) {
  life_.receive(state, actions_);
  start_.receive(state);
}

void HlcMachine::take(const coordination::Traffic& traffic) {
  if (traffic.vehicle == controller().options().vehicle) life_.readiness().receive_own_traffic();
  start_.receive(traffic);
  step_.receive(traffic);
}

void HlcMachine::take(const AutomatonRequest& request) {
  if (request.vehicle == controller().options().vehicle) subgraphs_.receive(request);
}

void HlcMachine::take(const AfterStepFailure& failure) {
  ending_.unwritten = "from step " + std::to_string(controller().last_step().value) +
                      " on not written: " + failure.reason;
  actions_.error(ending_.unwritten);
}

std::vector<HlcAction> HlcMachine::advance(const Instant& now) {
  copies_.publish_when_due(now.wall, actions_);
  if (!ending_.code && !ending_.is_asked) life_.watch(now.wall, has_started(), actions_);
  subgraphs_.prepare_next(actions_);
  while (!ending_.code && go_on(now)) {
  }
  return actions_.take();
}

bool HlcMachine::go_on(const Instant& now) {
  switch (phase_) {
    case Phase::kIdle:
      return take_list(now);
    case Phase::kGathering:
      return gather(now);
    case Phase::kPreparing:
      return prepare(now);
    case Phase::kStepping:
      return step(now);
    case Phase::kReporting:
      return report();
    case Phase::kAfterStep:
      return after_step(now);
    case Phase::kRefusing:
      return refuse(now);
  }
  return false;
}

bool HlcMachine::ends(const Instant& now) {
  ending_.code =
      ending_.is_asked
          ? std::optional{life_.is_stopped_for_good() ? kExitDied : kExitGood}
          : life_.exit_code(now.wall, phase_ == Phase::kIdle && !lists_.empty(), actions_);
  if (ending_.code == kExitGood && !ending_.unwritten.empty()) {
    actions_.error(ending_.unwritten);  // repeated as the last line of the log
    ending_.code = kExitNotWritten;
  }
  return ending_.code.has_value();
}

/// The step of a list never decreases: after one of the far future no list would be answered.
void HlcMachine::drop_lists_of_the_future(const Instant& now) {
  std::vector<machine::LogLine> lines;
  const std::uint8_t vehicle = controller().options().vehicle.value;
  std::erase_if(lists_, [&](const VehicleStateList& list) {
    return !stamp_check_.accepts({"state list", middleware_name, vehicle, list.t_now}, now,
                                 step_ns(controller()), lines);
  });
  for (machine::LogLine& line : lines) actions_.add(std::move(line));
}

bool HlcMachine::take_list(const Instant& now) {
  drop_lists_of_the_future(now);
  if (ends(now)) return false;
  life_.publish_ready(now.wall, controller(), has_started(), actions_);
  if (lists_.empty()) return false;
  if (!rules_.answers_every_list) lists_.erase(lists_.begin(), lists_.end() - 1);
  current_ = {.list = std::move(lists_.front())};
  lists_.pop_front();
  life_.receive_list(now.wall);
  if (const std::string problem = core_.validate(current_.list); !problem.empty()) {
    actions_.error(problem);
    current_.patience = now.wall + kStopRequestWait;
    phase_ = Phase::kRefusing;
    return true;
  }
  std::optional<controller::Observation> observation = core_.observe(current_.list);
  if (!observation) return true;  // received twice
  current_.observation = *std::move(observation);
  life_.readiness().set_active(current_.observation.active);
  phase_ = Phase::kGathering;
  return true;
}

bool HlcMachine::refuse(const Instant& now) {
  const bool is_received = life_.has_stop_request_readers();
  if (!is_received && now.wall < current_.patience && !ending_.is_asked) return false;
  if (is_received) actions_.add(StopRequest{.vehicle_id = controller().options().vehicle.value});
  ending_.code = kExitBadInput;
  return false;
}

bool HlcMachine::gather(const Instant& now) {
  if (rules_.start == StartRule::kTogether) {
    life_.update_readiness(now.wall, has_started(), actions_);
    if (!life_.readiness().is_ready()) {
      static_cast<void>(ends(now));
      return false;
    }
  }
  enter_experiment();
  current_.patience = now.wall + rules_.preparation_patience;
  phase_ = Phase::kPreparing;
  return true;
}

/// True if it begins with this list, or has begun.
void HlcMachine::enter_experiment() {
  const VehicleStateList& list = current_.list;
  controller::Observation& observation = current_.observation;
  observation.present = life_.readiness().present(observation.active);
  const bool had_begun = core_.has_begun();
  if (!had_begun) {
    core_.note(list, observation);
    if (start_.join_if_others_drive(observation, life_.has_stop_request_readers())) {
      actions_.warn("the others drive, but no lab control could stop this vehicle; not joining");
    }
  }
  step_.advance_to(observation.step);
  current_.is_running =
      life_.readiness().is_ready() && core_.begins(list, observation, rules_.start, start_.time());
  if (!current_.is_running) return;
  start_.enter(observation.step);
  if (!had_begun && start_.is_joining(list)) actions_.info("joining the running experiment");
}

bool HlcMachine::prepare(const Instant& now) {
  if (subgraphs_.is_preparing() && now.wall < current_.patience && !ending_.is_asked) return false;
  controller::Controller& controller = core_.controller();
  const controller::Observation& observation = current_.observation;
  const Nanoseconds from = cpu_time_();
  subgraphs_.begin_step(controller, current_.list, observation.step, start_.first_step(), actions_);
  current_.reconfiguring_ns = cpu_time_() - from;
  if (current_.is_running) {
    notes_.note_placement(controller, actions_);
    notes_.note_pose_lead(controller, observation, actions_);
    controller.set_minimal_risk_stop(life_.is_minimal_risk_stop());
    step_.begin(current_.list, observation, now, actions_);
    phase_ = Phase::kStepping;
    return false;
  }
  if (!may_stand_by()) {
    if (rules_.start == StartRule::kAtTrigger) {
      phase_ = Phase::kIdle;
      return true;
    }
    disregard_own_vehicle();
  }
  ReportRecord record{.report = step_.stand_by(observation)};
  if (core_.has_own_settled()) notes_.note_placement(controller, actions_);
  finish(std::move(record), now);
  return false;
}

bool HlcMachine::may_stand_by() const {
  const bool yields =
      rules_.start == StartRule::kAtTrigger && life_.readiness().yields_to_duplicate();
  return !yields && core_.may_stand_by(current_.observation, rules_.start);
}

/// Under kAtTrigger: until the experiment begins, and where the vehicle is off its route, the
/// operator moves it. Any command would be newer than the lab control centre's, which
/// are valid 300 ms after they are made.
bool HlcMachine::leaves_vehicle_alone(const coordination::Report& report) const {
  if (rules_.start != StartRule::kAtTrigger) return false;
  if (current_.is_running) {
    return report.reason == coordination::FallbackReason::kOffRoute ||
           controller().is_vehicle_lost();
  }
  return !controller().fits_route() || !has_started() || current_.list.t_now < *start_.time();
}

/// Under kTogether every list is answered: of a vehicle that is to be left alone without a plan, as
/// if it were not seen.
void HlcMachine::disregard_own_vehicle() {
  const VehicleId own = controller().options().vehicle;
  std::erase_if(current_.observation.states,
                [own](const coordination::MeasuredVehicle& one) { return one.vehicle == own; });
}

bool HlcMachine::step(const Instant& now) {
  std::optional<ReportRecord> record = step_.advance(
      now, [this](VehicleId vehicle) { return life_.readiness().is_reachable(vehicle); },
      ending_.is_asked, actions_);
  if (!record) return false;
  record->planning_ns += current_.reconfiguring_ns;
  finish(*std::move(record), now);
  return false;
}

/// The command is published before anything else is computed: the report follows in the next
/// iteration.
void HlcMachine::finish(ReportRecord record, const Instant& now) {
  publish_command(record.report, now);
  // A clock that is set back gives none.
  record.response_ns = std::max(now.run, current_.list.t_now) - current_.list.t_now;
  current_.record = std::move(record);
  phase_ = Phase::kReporting;
}

bool HlcMachine::report() {
  coordination::Report& report = current_.record.report;
  core_.controller().note_causes(report);
  core_.controller().note_bound(report);
  if (current_.is_running) {
    notes_.note_step(controller(), report, actions_);
    if (step_.two_rounds() != nullptr) {
      notes_.note_rounds(report.vehicle, *step_.two_rounds(), actions_);
    }
  }
  actions_.add(current_.record);
  actions_.add(
      DrawStep{.report = report, .time_to_live = kDrawnPeriods * period_of(current_.list)});
  if (core_.has_begun() && ending_.unwritten.empty()) actions_.add(AfterStep{});
  phase_ = Phase::kAfterStep;
  return false;
}

/// Also enters it in the report if it is not the plan. Without points it only answers the list.
void HlcMachine::publish_command(coordination::Report& report, const Instant& now) {
  if (ending_.is_asked || leaves_vehicle_alone(report)) return;
  const AnswerToList answer = core_.answer(current_.list);
  const bool is_due = rules_.start == StartRule::kTogether || !answer.command.points.empty();
  if (is_due) copies_.publish(answer, now.wall, actions_);
  notes_.note_fault(step_of(current_.list), answer, actions_);
  report = with_answer(std::move(report), answer);
}

bool HlcMachine::after_step(const Instant& now) {
  if (current_.is_running) {
    const bool is_published = actions_.empty() && !copies_.due();
    if (subgraphs_.looks_ahead() && !is_published) return false;
    const bool has_time = !rules_.deadlines ||
                          now.run < deadline_in_step(current_.list, rules_.deadlines->look_ahead);
    subgraphs_.end_step(controller(), current_.record.report, has_time);
  }
  phase_ = Phase::kIdle;
  return true;
}

WakeUp HlcMachine::wake_up() const {
  const std::optional<Nanoseconds> copy = copies_.due();
  if (ending_.code) return {.wall = copy};
  switch (phase_) {
    case Phase::kIdle:
    case Phase::kGathering:
      return {.wall = machine::earlier(copy, life_.wake_up())};
    case Phase::kPreparing:
    case Phase::kRefusing:
      return {.wall = machine::earlier(copy, current_.patience)};
    case Phase::kStepping: {
      const WakeUp wake = step_.wake_up();
      return {.run = wake.run, .wall = machine::earlier(copy, wake.wall)};
    }
    case Phase::kReporting:
      return {.wall = kAtOnce};
    case Phase::kAfterStep:
      return {.wall = subgraphs_.looks_ahead() && copy ? *copy : kAtOnce};
  }
  return {};
}

std::size_t HlcMachine::awaited() const {
  if (phase_ != Phase::kStepping) return machine::kOnlyUrgent;
  return std::max<std::size_t>(step_.num_awaited(), 1);
}

std::optional<int> HlcMachine::exit_code() const {
  return copies_.due() ? std::nullopt : ending_.code;
}

}  // namespace hlc::high_level_controller
