#include "vehicle_sim/closed_loop/fault_run.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <deque>
#include <map>
#include <memory>
#include <utility>

#include "hlc_bridge/lab_control/logical_run.hpp"
#include "hlc_bridge/lab_control/real_time_run.hpp"
#include "planner/coordination/plan.hpp"
#include "vehicle_sim/closed_loop/controller_host.hpp"
#include "vehicle_sim/closed_loop/event_queue.hpp"
#include "vehicle_sim/closed_loop/lab_control_host.hpp"
#include "vehicle_sim/closed_loop/middleware_host.hpp"
#include "vehicle_sim/closed_loop/seeded_random.hpp"
#include "vehicle_sim/closed_loop/simulated_clock.hpp"
#include "vehicle_sim/closed_loop/simulated_network.hpp"
#include "vehicle_sim/closed_loop/simulated_process.hpp"
#include "vehicle_sim/closed_loop/vehicle_host.hpp"

namespace hlc::closed_loop {
namespace {

constexpr Nanoseconds kMilli = kNanosecondsPerMillisecond;
/// True time at which a run begins: whole steps, and far from 0, so that no clock can show less.
constexpr Nanoseconds kBegin = 1000 * kNanosecondsPerSecond;
constexpr Nanoseconds kLastStart = 500 * kMilli;
/// After the interruption everybody has left: vehicles brake for a second; who has lost its lab
/// control stays for kVehicleStays after the lease.
constexpr Nanoseconds kLeaveTime = 10 * kNanosecondsPerSecond;
/// Logical time: a run stands still for 10 s of silence per process that is not heard, leases are
/// 10 s, and who hears no trigger gives up after a minute.
constexpr Nanoseconds kLogicalPatience = 180 * kNanosecondsPerSecond;
constexpr Nanoseconds kCheckPeriod = 100 * kMilli;
/// A process takes so long from what wakes it until it acts.
constexpr Nanoseconds kLeastReaction = 20'000;
constexpr Nanoseconds kMostReaction = 150'000;
/// No process has this many turns in a check period, but one that waits for what is over.
constexpr std::uint64_t kMostTurns = 2'000;
constexpr Nanoseconds kProgressInterval = 60 * kNanosecondsPerSecond;
constexpr Nanoseconds kStartupTimeout = 30 * kNanosecondsPerSecond;

enum class Role : std::uint8_t { kLabControl, kVehicle, kMiddleware, kController };

/// A process with its clocks. They outlive it.
struct Seat {
  Role role{};
  std::uint8_t vehicle{};
  std::string name;
  SimulatedClock run_clock{0, 0, 0};
  SimulatedClock wall_clock{0, 0, 0};
  std::unique_ptr<SimulatedProcess> process;  ///< none: not started, killed, or ended
  NodeId node{};
  bool is_frozen{};
  bool is_killed{};
  std::optional<int> exit_code;
  std::deque<std::pair<std::size_t, SharedMessage>> unread;  ///< while frozen
  Nanoseconds planned_turn{kNoTurn};
  std::uint32_t generation{};
  std::uint64_t turns{};
  std::uint64_t random_count{};
};

class Run final : public RunObserver {
 public:
  Run(const Scenario& scenario, const FaultRunSettings& settings, const Trace& trace)
      : scenario_(scenario),
        settings_(settings),
        trace_(trace),
        queue_(kBegin),
        network_(queue_, network_options(settings)),
        footprints_(footprint_of(scenario), starts_of(scenario)),
        plans_(scenario.horizon_steps),
        planning_(end_of(settings.faults)) {
    for (const ScenarioVehicle& vehicle : scenario.vehicles) ids_.push_back(vehicle.id.value);
    add_seat(Role::kLabControl, 0, kLabControlName);
    for (const std::uint8_t id : ids_) {
      add_seat(Role::kVehicle, id, vehicle_name(id));
      add_seat(Role::kMiddleware, id, middleware_name(id));
      add_seat(Role::kController, id, controller_name(id));
    }
    for (std::uint32_t i = 0; i < settings.faults.size(); ++i) {
      queue_.add(kBegin + settings.faults[i].begin, {.what = Happening::kFaultBegin, .detail = i});
      queue_.add(kBegin + settings.faults[i].end, {.what = Happening::kFaultEnd, .detail = i});
    }
    queue_.add(kBegin + kCheckPeriod, {.what = Happening::kCheck});
  }

  FaultRunResult drive() {
    while (!queue_.empty() && !is_over_) {
      Event event = queue_.take();
      now_ = queue_.now();
      handle(event);
    }
    footprints_.judge(since_begin(), result_.violations);
    result_.hash = hash_;
    result_.events = queue_.count();
    result_.smallest_distance_m = footprints_.smallest_distance_m();
    return std::move(result_);
  }

  // RunObserver
  void on_log(NodeId node, const machine::LogLine& line) override {
    const std::string& name = network_.name(node);
    ends_.log(name, line);
    for (const char letter : line.text) add_to_hash(static_cast<unsigned char>(letter));
    tell([&] { return name + ": " + line.text; });
  }
  void on_driven(std::uint8_t vehicle, Nanoseconds time, const DrivenSample& sample) override {
    footprints_.driven(vehicle, (time + kVehiclePeriod / 2) / kVehiclePeriod, sample.pose);
    last_poses_[vehicle] = sample.pose;
    add_to_hash(std::bit_cast<std::uint64_t>(sample.pose.x_m));
    add_to_hash(std::bit_cast<std::uint64_t>(sample.pose.y_m));
    add_to_hash(sample.command_create);
  }
  void on_step(const Controller& controller) override {
    plans_.changed(controller.options().vehicle,
                   controller.plan_in_force().areas_from(controller.last_step()), since_begin(),
                   result_.violations);
  }
  void on_report(NodeId /*node*/, const ReportRecord& record) override {
    const Report& report = record.report;
    ++result_.car_steps;
    if (report.status == StepStatus::kPlanned) ++result_.planned;
    planning_.report(record, since_begin());
    add_to_hash(report.step.value);
    add_to_hash(static_cast<std::uint64_t>(report.status));
    add_to_hash(std::bit_cast<std::uint64_t>(report.cost_m2));
    tell([&] { return report_line(report); });
  }
  void on_command(NodeId /*node*/, const TrajectoryCommand& command) override {
    add_to_hash(command.create_stamp);
  }

 private:
  static NetworkOptions network_options(const FaultRunSettings& settings) {
    const Nanoseconds lease = (settings.is_logical ? 10 : 2) * kNanosecondsPerSecond;
    return {.seed = mixed(settings.seed, 1),
            .transport = settings.transport,
            .lease = lease,
            .least_delay = 50'000,
            .most_delay = settings.is_logical ? Nanoseconds{200'000} : 1 * kMilli};
  }
  static Footprint footprint_of(const Scenario& scenario) {
    return scenario.subgraph->automaton().vehicle.footprint;
  }
  static std::map<std::uint8_t, Pose> starts_of(const Scenario& scenario) {
    std::map<std::uint8_t, Pose> starts;
    for (const ScenarioVehicle& vehicle : scenario.vehicles) {
      starts[vehicle.id.value] = measured_start(scenario, vehicle);
    }
    return starts;
  }
  static std::string report_line(const Report& report) {
    std::array<char, 160> text{};
    std::snprintf(text.data(), text.size(), "vehicle %d, step %llu: %s, %s, at (%.3f, %.3f)",
                  int{report.vehicle.value}, static_cast<unsigned long long>(report.step.value),
                  to_string(report.status), to_string(report.reason), report.planned_pose.x_m,
                  report.planned_pose.y_m);
    return text.data();
  }

  [[nodiscard]] Nanoseconds since_begin() const { return now_ - kBegin; }
  template <class Line>
  void tell(Line line) const {
    if (trace_) trace_(since_begin(), line());
  }
  void add_to_hash(std::uint64_t value) { hash_ = mixed(hash_ ^ value, now_); }

  // --- processes --------------------------------------------------------------------------------

  void add_seat(Role role, std::uint8_t vehicle, std::string name) {
    SeededRandom random(mixed(settings_.seed, 1000 + seats_.size()));
    const auto ppb = static_cast<std::int64_t>(random.below(40'001)) - 20'000;
    Seat seat{.role = role, .vehicle = vehicle, .name = std::move(name)};
    seat.run_clock = SimulatedClock(kBegin, kBegin + random.below(400'001) - 200'000, ppb);
    seat.wall_clock = SimulatedClock(kBegin, random.between(1, 1'000'000) * kMilli, ppb);
    const auto index = static_cast<std::uint32_t>(seats_.size());
    queue_.add(kBegin + random.below(kLastStart), {.what = Happening::kStart, .detail = index});
    seat_by_name_[seat.name] = index;
    seats_.push_back(std::move(seat));
  }

  void start(Seat& seat) {
    seat.node = network_.join(description_of(seat));
    seat_of_node_.push_back(static_cast<std::uint32_t>(&seat - seats_.data()));
    seat.is_killed = false;
    seat.planned_turn = kNoTurn;
    ends_.started(seat.name);
    tell([&] { return seat.name + " starts"; });
    seat.process = make_process(seat);
    plan_turn(seat);
  }

  [[nodiscard]] NodeDescription description_of(const Seat& seat) const {
    switch (seat.role) {
      case Role::kLabControl:
        return LabControlHost::description(ids_, settings_.is_logical);
      case Role::kVehicle:
        return VehicleHost::description(seat.vehicle);
      case Role::kMiddleware:
        return MiddlewareHost::description(seat.vehicle, ids_);
      case Role::kController:
        return ControllerHost::description(seat.vehicle);
    }
    return {};
  }

  template <class Host>
  std::unique_ptr<SimulatedProcess> wrap(Seat& seat, Host host, typename Host::Machine machine) {
    const ProcessPlace place{.node = seat.node,
                             .network = &network_,
                             .observer = this,
                             .run_clock = &seat.run_clock,
                             .wall_clock = &seat.wall_clock,
                             .now = &now_,
                             .is_logical = settings_.is_logical};
    return std::make_unique<MachineProcess<Host>>(place, std::move(host), std::move(machine),
                                                  kStartupTimeout);
  }

  std::unique_ptr<SimulatedProcess> make_process(Seat& seat) {
    switch (seat.role) {
      case Role::kLabControl:
        return wrap(seat, LabControlHost(),
                    LabControlMachine(make_lab_run(), kProgressInterval));
      case Role::kVehicle:
        return wrap(seat, VehicleHost(seat.vehicle), VehicleMachine(vehicle_options(seat)));
      case Role::kMiddleware:
        return wrap(seat, MiddlewareHost(seat.vehicle, ids_),
                    MiddlewareMachine(middleware_settings(seat)));
      case Role::kController:
        return wrap(seat, ControllerHost(),
                    HlcMachine(hlc_settings(), make_controller(scenario_, VehicleId{seat.vehicle})));
    }
    return nullptr;
  }

  [[nodiscard]] std::unique_ptr<LabRun> make_lab_run() const {
    if (settings_.is_logical) return std::make_unique<LogicalRun>(lab_settings());
    return std::make_unique<RealTimeRun>(lab_settings());
  }
  [[nodiscard]] LabRunSettings lab_settings() const {
    const double step_s = scenario_.subgraph->automaton().step_s;
    return {.vehicle_ids = ids_,
            .period = static_cast<Nanoseconds>(std::llround(1e9 * step_s)),
            .steps = settings_.is_logical ? settings_.steps : 1'000'000,
            .startup_timeout = kStartupTimeout,
            .on_death = settings_.is_logical ? OnDeath::kStop : OnDeath::kContinue};
  }
  /// A vehicle that is started again starts where it stands.
  [[nodiscard]] VehicleMachineOptions vehicle_options(const Seat& seat) const {
    const auto last = last_poses_.find(seat.vehicle);
    const Pose start =
        last != last_poses_.end()
            ? last->second
            : measured_start(scenario_, vehicle_of(scenario_, VehicleId{seat.vehicle}));
    return {.vehicle = {.vehicle_id = seat.vehicle,
                        .start = start,
                        .noise_seed = mixed(settings_.seed, seat.vehicle)},
            .rules = settings_.is_logical ? machine::logical_rules()
                                          : machine::real_rules(kVehicleStays),
            .startup_timeout = kStartupTimeout};
  }
  [[nodiscard]] MiddlewareSettings middleware_settings(const Seat& seat) const {
    return {.vehicle_ids = {seat.vehicle},
            .startup_timeout = kStartupTimeout,
            .rules = settings_.is_logical ? logical_middleware_rules(false)
                                          : real_middleware_rules(false)};
  }
  [[nodiscard]] HlcSettings hlc_settings() const {
    const bool keeps_commands = settings_.transport == Transport::kLoopback;
    return {.rules = settings_.is_logical
                         ? rules_in_logical_time(keeps_commands)
                         : rules_in_real_time(keeps_commands, StepDeadlines{}, kStartupTimeout),
            .startup_timeout = kStartupTimeout,
            .reconfiguration = scenario_.reconfiguration};
  }

  /// When the process has its next turn, if that is earlier than what was planned.
  void plan_turn(Seat& seat) {
    if (!seat.process || seat.is_frozen) return;
    const Nanoseconds next = seat.process->next_turn();
    if (next == kNoTurn) return;
    const Nanoseconds reaction =
        kLeastReaction + mixed(settings_.seed ^ seat.node, seat.random_count++) %
                             (kMostReaction - kLeastReaction);
    const Nanoseconds at = std::max(next, now_) + reaction;
    if (at >= seat.planned_turn) return;
    seat.planned_turn = at;
    queue_.add(at, {.what = Happening::kWakeUp,
                    .node = seat.node,
                    .generation = ++seat.generation});
  }

  void turn(Seat& seat) {
    seat.planned_turn = kNoTurn;
    ++seat.turns;
    seat.process->turn();
    if (const std::optional<int> code = seat.process->exit_code()) return end(seat, *code);
    plan_turn(seat);
  }

  void end(Seat& seat, int exit_code) {
    tell([&] { return seat.name + " ends with code " + std::to_string(exit_code); });
    network_.leave(seat.node);
    seat.process.reset();
    seat.exit_code = exit_code;
    ends_.ended(seat.name, exit_code, since_begin(), result_.violations);
    if (seat.role == Role::kVehicle) footprints_.ended(seat.vehicle);
    add_to_hash(static_cast<std::uint64_t>(exit_code));
    is_over_ = std::ranges::all_of(seats_, [](const Seat& other) {
      return !other.process && !other.is_killed && other.exit_code;
    });
  }

  // --- events -----------------------------------------------------------------------------------

  [[nodiscard]] Seat* seat_of(NodeId node) {
    Seat& seat = seats_[seat_of_node_[node]];
    return seat.process && seat.node == node ? &seat : nullptr;
  }

  void handle(Event& event) {
    switch (event.what) {
      case Happening::kArrival:
        return arrive(std::move(event));
      case Happening::kSight:
        return look(event);
      case Happening::kWakeUp: {
        Seat* const seat = seat_of(event.node);
        if (seat && !seat->is_frozen && seat->generation == event.generation) turn(*seat);
        return;
      }
      case Happening::kFaultBegin:
        return begin(settings_.faults[event.detail]);
      case Happening::kFaultEnd:
        return finish(settings_.faults[event.detail]);
      case Happening::kStart:
        // It may have been killed before its first start: then it is started afterwards.
        if (!seats_[event.detail].is_killed) start(seats_[event.detail]);
        return;
      case Happening::kCheck:
        return check();
    }
  }

  void arrive(Event event) {
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

  void look(const Event& event) {
    if (!network_.look(event)) return;
    Seat* const seat = seat_of(event.node);
    if (!seat) return;
    seat->process->presence_changed();
    plan_turn(*seat);
  }

  // --- faults -----------------------------------------------------------------------------------

  [[nodiscard]] Seat& seat_of(const std::string& name) { return seats_[seat_by_name_.at(name)]; }

  static Disturbance disturbance_of(const Fault& fault) {
    const auto amount = static_cast<Nanoseconds>(std::max<std::int64_t>(fault.amount, 0));
    Disturbance disturbance{.from = fault.process, .to = fault.peer};
    switch (fault.kind) {
      case FaultKind::kLose:
        disturbance.lost = fault.share;
        break;
      case FaultKind::kWithhold:
        disturbance.withheld = fault.share;
        break;
      case FaultKind::kRepeat:
        disturbance.repeated = fault.share;
        disturbance.repeat_delay = amount;
        break;
      case FaultKind::kReorder:
        disturbance.overtaken = fault.share;
        disturbance.overtake_delay = amount;
        break;
      default:
        disturbance.delay = amount;
        break;
    }
    return disturbance;
  }

  void begin(const Fault& fault) {
    tell([&] { return "fault begins: " + to_string(fault); });
    switch (fault.kind) {
      case FaultKind::kCut:
        return network_.add(Cut{.from = fault.process, .to = fault.peer});
      case FaultKind::kKill:
        return kill(seat_of(fault.process));
      case FaultKind::kFreeze:
        return freeze(seat_of(fault.process));
      case FaultKind::kStep:
        return set_clock(fault, fault.amount, 0);
      case FaultKind::kDrift:
        return set_clock(fault, 0, fault.amount);
      default:
        return network_.add(disturbance_of(fault));
    }
  }

  void finish(const Fault& fault) {
    tell([&] { return "fault ends: " + to_string(fault); });
    switch (fault.kind) {
      case FaultKind::kCut:
        return network_.remove(Cut{.from = fault.process, .to = fault.peer});
      case FaultKind::kKill: {
        Seat& seat = seat_of(fault.process);
        if (seat.is_killed) start(seat);
        return;
      }
      case FaultKind::kFreeze:
        return thaw(seat_of(fault.process));
      case FaultKind::kStep:
        return set_clock(fault, -fault.amount, 0);
      case FaultKind::kDrift:
        return set_clock(fault, 0, -fault.amount);
      default:
        return network_.remove(disturbance_of(fault));
    }
  }

  void kill(Seat& seat) {
    if (seat.exit_code) return;  // it has ended by itself
    seat.is_killed = true;
    seat.is_frozen = false;
    seat.unread.clear();
    if (!seat.process) return;
    seat.process.reset();
    network_.vanish(seat.node);
  }

  void freeze(Seat& seat) {
    if (!seat.process) return;
    seat.is_frozen = true;
    seat.planned_turn = kNoTurn;
    ++seat.generation;
    network_.freeze(seat.node);
  }

  void thaw(Seat& seat) {
    if (!seat.process || !seat.is_frozen) return;
    seat.is_frozen = false;
    for (const auto& [topic, message] : std::exchange(seat.unread, {})) {
      seat.process->receive(topic, *message);
    }
    network_.thaw(seat.node);
    plan_turn(seat);
  }

  void set_clock(const Fault& fault, std::int64_t step, std::int64_t drift) {
    Seat& seat = seat_of(fault.process);
    if (step != 0) seat.run_clock.step(now_, step);
    if (drift != 0) {
      seat.run_clock.set_drift(now_, seat.run_clock.drift_ppb() + drift);
      seat.wall_clock.set_drift(now_, seat.wall_clock.drift_ppb() + drift);
    }
    if (!seat.process) return;
    seat.process->clocks_changed();
    plan_turn(seat);
  }

  // --- checks -----------------------------------------------------------------------------------

  void check() {
    queue_.add(now_ + kCheckPeriod, {.what = Happening::kCheck});
    footprints_.judge(since_begin(), result_.violations);
    check_waits();
    if (settings_.is_logical) return check_logical_end();
    const Nanoseconds calm_from = end_of(settings_.faults);
    if (!is_planning_judged_ && since_begin() >= calm_from + PlanningCheck::kPatience) {
      is_planning_judged_ = true;
      planning_.judge(able_vehicles(), since_begin(), result_.violations);
    }
    if (!interrupted_at_ && since_begin() >= calm_from + settings_.calm) interrupt();
    if (interrupted_at_ && now_ >= *interrupted_at_ + kLeaveTime) expect_nobody();
  }

  /// Nobody asks again and again for what is over; and in real time everybody who runs has a time at
  /// which it goes on though nothing comes. (In logical time a controller waits for its middleware
  /// alone, whose waits end.)
  void check_waits() {
    for (Seat& seat : seats_) {
      const std::uint64_t turns = std::exchange(seat.turns, 0);
      if (!seat.process || seat.is_frozen) continue;
      if (turns > kMostTurns) complain(seat.name + " spins: " + std::to_string(turns) + " turns");
      if (seat.planned_turn == kNoTurn && !settings_.is_logical) complain(seat.name + " waits without an end");
    }
  }
  void complain(const std::string& text) {
    if (!is_waiting_told_) {
      result_.violations.push_back({.at = since_begin(), .check = "waits", .text = text});
    }
    is_waiting_told_ = true;
  }

  void check_logical_end() {
    if (since_begin() >= end_of(settings_.faults) + kLogicalPatience) expect_nobody();
  }

  [[nodiscard]] std::vector<std::uint8_t> able_vehicles() const {
    std::vector<std::uint8_t> able;
    if (!seats_.front().process) return able;  // without the lab control everybody drives out
    for (const std::uint8_t id : ids_) {
      const bool is_complete = std::ranges::all_of(
          seats_, [id](const Seat& seat) { return seat.vehicle != id || seat.process; });
      if (is_complete) able.push_back(id);
    }
    return able;
  }

  void interrupt() {
    interrupted_at_ = now_;
    tell([] { return std::string("the run is interrupted"); });
    Seat& lab_control = seats_.front();
    if (!lab_control.process) return;
    lab_control.process->stop();
    plan_turn(lab_control);
  }

  void expect_nobody() {
    is_over_ = true;
    for (const Seat& seat : seats_) {
      if (seat.process) complain(seat.name + " does not end");
    }
  }

  const Scenario& scenario_;
  const FaultRunSettings& settings_;
  const Trace& trace_;
  EventQueue queue_;
  Nanoseconds now_{kBegin};
  SimulatedNetwork network_;
  std::vector<std::uint8_t> ids_;
  std::vector<Seat> seats_;
  std::map<std::string, std::uint32_t> seat_by_name_;
  std::vector<std::uint32_t> seat_of_node_;
  std::map<std::uint8_t, Pose> last_poses_;
  FootprintsCheck footprints_;
  PlansCheck plans_;
  EndsCheck ends_;
  PlanningCheck planning_;
  FaultRunResult result_;
  std::uint64_t hash_{};
  std::optional<Nanoseconds> interrupted_at_;
  bool is_planning_judged_{};
  bool is_waiting_told_{};
  bool is_over_{};
};

}  // namespace

FaultRunResult run_with_faults(const Scenario& scenario, const FaultRunSettings& settings,
                               const Trace& trace) {
  return Run(scenario, settings, trace).drive();
}

}  // namespace hlc::closed_loop
