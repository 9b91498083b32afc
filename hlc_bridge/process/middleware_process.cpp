#include "hlc_bridge/process/middleware_process.hpp"

#include <fmt/ranges.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <thread>
#include <type_traits>
#include <utility>
#include <vector>

#include "hlc_bridge/messages/exit_codes.hpp"
#include "hlc_bridge/messages/node_names.hpp"
#include "hlc_bridge/process/goal_forwarder.hpp"
#include "hlc_bridge/time/real_timer.hpp"

namespace hlc {
namespace {

constexpr std::chrono::milliseconds kRequestInterval{100};
constexpr std::chrono::milliseconds kLookInterval{500};
constexpr std::chrono::seconds kNextRequestInterval{1};
constexpr std::chrono::nanoseconds kSilence{kMessageTimeout};
constexpr std::chrono::milliseconds kLeaveTime{500};

ParticipantOptions on_domain(const MiddlewareOptions& options, DomainRole role) {
  const bool lab = role == DomainRole::kLab;
  return {.name = middleware_name(options.vehicle_ids.front()),
          .domain_id = lab ? options.lab_domain : options.local_domain,
          .role = role,
          .transport = options.transport,
          .logical_time = options.logical_time,
          .discovery_server = lab ? options.discovery_server : std::nullopt,
          .version = options.version,
          .on_loss = [id = options.node_id](const std::string& line) {
            spdlog::warn("{}: {}", id, line);
          }};
}

}  // namespace

struct MiddlewareProcess::Vehicle {
  Vehicle(MiddlewareProcess& process, std::uint8_t id)
      : trajectory{process.lab_, topics::vehicle_command(id),
                   [&process] { process.signal_.notify(); }} {
    if (process.options_.transport == Transport::kLab) {
      path_tracking.emplace(process.lab_, topics::vehicle_command<PathTrackingCommand>(id));
      speed_curvature.emplace(process.lab_, topics::vehicle_command<SpeedCurvatureCommand>(id));
      direct.emplace(process.lab_, topics::vehicle_command<DirectCommand>(id));
    }
  }

  void write(const TrajectoryCommand& command) { trajectory.write(command); }
  void write(const PathTrackingCommand& command) { path_tracking->write(command); }
  void write(const SpeedCurvatureCommand& command) { speed_curvature->write(command); }
  void write(const DirectCommand& command) { direct->write(command); }

  Writer<TrajectoryCommand> trajectory;
  std::optional<Writer<PathTrackingCommand>> path_tracking;
  std::optional<Writer<SpeedCurvatureCommand>> speed_curvature;
  std::optional<Writer<DirectCommand>> direct;
};

struct MiddlewareProcess::LabEndpoints {
  explicit LabEndpoints(MiddlewareProcess& process)
      : path_tracking{reader<PathTrackingCommand>(process)},
        speed_curvature{reader<SpeedCurvatureCommand>(process)},
        direct{reader<DirectCommand>(process)},
        goals{process.lab_, process.local_} {}

  template <class Command>
  static Reader<Command> reader(MiddlewareProcess& process) {
    return Reader<Command>{process.local_, topics::command<Command>(),
                           [&process](const Command& command) {
                             process.mail_.post([&] { process.to_carry_.emplace_back(command); });
                           },
                           [&process] { process.signal_.notify(); }};
  }

  [[nodiscard]] std::size_t matched() const {
    return std::max({path_tracking.matched(), speed_curvature.matched(), direct.matched()});
  }

  Reader<PathTrackingCommand> path_tracking;
  Reader<SpeedCurvatureCommand> speed_curvature;
  Reader<DirectCommand> direct;
  GoalForwarder goals;
  std::map<std::uint8_t, Reader<VehicleObservation>> observations;
};

MiddlewareProcess::MiddlewareProcess(MiddlewareOptions options)
    : options_(std::move(options)),
      lab_(on_domain(options_, DomainRole::kLab), [this] { signal_.notify(); }),
      local_(on_domain(options_, DomainRole::kLocal), [this] { signal_.notify(); }),
      list_writer_(local_, topics::vehicle_state_list(), [this] { signal_.notify(); }),
      trigger_writer_(local_, topics::system_trigger(), [this] { signal_.notify(); }),
      ready_writer_(lab_, topics::ready_status(), [this] { signal_.notify(); }),
      request_writer_(lab_, topics::parameter_request()),
      parameter_reader_(
          lab_, topics::parameter(),
          [this](const Parameter& parameter) {
            signal_.post([&] { (between_experiments_ ? next_ : parameters_).take(parameter); });
          }),
      trigger_reader_(
          lab_, topics::system_trigger(), [this](const SystemTrigger& trigger) { take(trigger); },
          [this] { signal_.notify(); }),
      command_reader_(
          local_, topics::command(),
          [this](const TrajectoryCommand& command) {
            mail_.post([&] { to_carry_.emplace_back(command); });
          },
          [this] { signal_.notify(); }),
      ready_reader_(
          local_, topics::ready_status(),
          [this](const ReadyStatus& status) {
            for (const std::uint8_t id : options_.vehicle_ids) {
              if (status.source_id == controller_ready_id(id)) {
                signal_.post([&] { ready_controllers_.insert(id); });
              }
            }
          },
          [this] { signal_.notify(); }) {
  for (const std::uint8_t id : options_.vehicle_ids) {
    vehicles_.emplace(id, std::make_unique<Vehicle>(*this, id));
    newest_answers_[id] = 0;
  }
  if (options_.transport == Transport::kLab) {
    lab_endpoints_ = std::make_unique<LabEndpoints>(*this);
    silent_controllers_.insert(options_.vehicle_ids.begin(), options_.vehicle_ids.end());
  }
}

MiddlewareProcess::~MiddlewareProcess() = default;

void MiddlewareProcess::stop() {
  signal_.post([this] {
    stop_ = true;
    if (timer_in_use_ != nullptr) {
      timer_in_use_->stop();
    }
  });
}

int MiddlewareProcess::run() {
  class Carrier {
   public:
    explicit Carrier(MiddlewareProcess& process)
        : process_{process}, thread_{[&process] { process.carry_everything(); }} {}
    ~Carrier() {
      process_.mail_.post([this] { process_.carrier_ends_ = true; });
      thread_.join();
    }

   private:
    MiddlewareProcess& process_;
    std::thread thread_;
  };
  int code = kExitGood;
  {
    const Carrier carrier{*this};
    code = keep_period();
  }
  if (signal_.locked([this] { return stop_symbol_; })) {
    let_controllers_leave();
  }
  return code;
}

int MiddlewareProcess::keep_period() {
  const int problem = prepare();
  if (problem != kExitGood || signal_.locked([this] { return stop_; })) {
    return problem;
  }
  make_timer();
  while (const std::optional<Nanoseconds> t_now = timer_->wait_next()) {
    tick(*t_now);
    if (!options_.logical_time) watch_lab_control(*t_now);
  }
  const bool has_given_up = signal_.locked([this] {
    const LogicalTimer* logical = logical_timer_;
    timer_in_use_ = logical_timer_ = nullptr;
    return logical != nullptr && logical->has_given_up();
  });
  if (missed_answers_ > 0) {
    spdlog::warn("{}: {} lists without an answer in time", options_.node_id, missed_answers_);
  }
  if (lab_control_lost_ || has_given_up) {
    spdlog::error("{}: {} {}", options_.node_id, kLabControlName,
                  has_given_up ? "hangs: no trigger comes any more" : "is gone");
    return kExitDied;
  }
  return kExitGood;
}

/// Real time: the controller needs lists until its car stands.
void MiddlewareProcess::watch_lab_control(Nanoseconds t_now) {
  if (!lab_.is_lost(kLabControlName)) {
    lab_control_lost_at_.reset();
  } else if (!lab_control_lost_at_) {
    lab_control_lost_at_ = t_now;
  } else if (t_now > *lab_control_lost_at_ + kMiddlewareStays) {
    lab_control_lost_ = true;
    timer_->stop();
  }
}

/// The controllers get the stop symbol before their middleware is gone, and so leave without alarm.
void MiddlewareProcess::let_controllers_leave() const {
  static_cast<void>(signal_.wait_until(Clock::now() + kLeaveTime,
                                       [this] { return controllers_that_command() == 0; }));
}

std::size_t MiddlewareProcess::controllers_that_command() const {
  return std::max(command_reader_.matched(), lab_endpoints_ ? lab_endpoints_->matched() : 0);
}

// --- start --------------------------------------------------------------------------------------

bool MiddlewareProcess::learn_parameters(Clock::time_point deadline) {
  return signal_.repeat_until(
      deadline, kRequestInterval, [this] { return stop_ || parameters_.complete(); },
      [this] {
        const auto missing = signal_.locked([this] { return parameters_.missing(); });
        for (const std::string& name : missing) request_writer_.write({.name = name});
        if (wait_notice_.is_due()) {
          spdlog::info("{}: waits for {} to tell {}", options_.node_id, kLabControlName,
                       fmt::join(missing, ", "));
        }
      });
}

bool MiddlewareProcess::wait_for_everybody(Clock::time_point deadline) {
  return signal_.repeat_until(
      deadline, kLookInterval, [this] { return stop_ || is_connected(); },
      [this] {
        if (!wait_notice_.is_due()) return;
        spdlog::info("{}: waits for {}", options_.node_id, who_is_missing());
      });
}

std::string MiddlewareProcess::parameter_problem(const RunParameters& parameters) const {
  if (parameters.period() <= options_.offset) {
    return fmt::format("{} = {} ms, must be more than --offset_nanoseconds = {}", kPeriodParameter,
                       parameters.period() / kNanosecondsPerMillisecond, options_.offset);
  }
  const auto is_wrong = [](std::int32_t id) { return id < 1 || id > 255; };
  const auto is_active_once = [&](std::uint8_t id) {
    return std::ranges::count(parameters.active_ids(), id) == 1;
  };
  if (std::ranges::any_of(parameters.active_ids(), is_wrong) ||
      !std::ranges::all_of(options_.vehicle_ids, is_active_once)) {
    return fmt::format("{} = {}, must be in 1 ... 255 and hold --vehicle_ids = {} once",
                       kActiveIdsParameter, fmt::join(parameters.active_ids(), ","),
                       fmt::join(options_.vehicle_ids, ","));
  }
  return {};
}

/// Whoever is told that this vehicle is ready may start the experiment: lists must hold its
/// vehicles by then, also those that the operator has added since the last one.
bool MiddlewareProcess::knows_next_experiment() {
  if (!signal_.locked([this] { return between_experiments_; })) return true;
  ask_for_next_experiment();
  const RunParameters next = signal_.locked([this] { return next_; });
  if (next.complete()) {
    std::string problem = parameter_problem(next);
    if (problem.empty() && next.period() != parameters_.period()) {
      problem = fmt::format("{} = {} ms, allowed the {} ms of this process's start",
                            kPeriodParameter, next.period() / kNanosecondsPerMillisecond,
                            parameters_.period() / kNanosecondsPerMillisecond);
    }
    if (problem != next_problem_ && !problem.empty()) {
      spdlog::error("{}: not ready for the next experiment: {}", options_.node_id, problem);
    }
    next_problem_ = problem;
    signal_.locked([&] {
      knows_next_ = problem.empty();
      if (knows_next_) parameters_ = next;
    });
    if (problem.empty()) listen_to_vehicles();
  }
  return signal_.locked([this] { return knows_next_; });
}

/// Again and again: the operator may change his mind until he starts it.
void MiddlewareProcess::ask_for_next_experiment() {
  if (Clock::now() < next_request_) return;
  next_request_ = Clock::now() + kNextRequestInterval;
  signal_.locked([this] { next_ = RunParameters{}; });
  for (const char* name : {kPeriodParameter, kActiveIdsParameter}) {
    request_writer_.write({.name = name});
  }
}

void MiddlewareProcess::listen_to_vehicles() {
  for (const std::int32_t active : parameters_.active_ids()) {
    const auto id = static_cast<std::uint8_t>(active);
    state_readers_.try_emplace(
        id, lab_, topics::vehicle_state(id),
        [this, id](const VehicleState& state) {
          signal_.post([&] {
            states_.add(id, state);
            silent_vehicles_.erase(id);
          });
        },
        [this] { signal_.notify(); });
    if (lab_endpoints_) {
      lab_endpoints_->observations.try_emplace(id, lab_, topics::vehicle_observation(id),
                                               [this, id](const VehicleObservation& seen) {
                                                 signal_.post([&] {
                                                   VehicleObservation& newest = observations_[id];
                                                   if (seen.create_stamp >= newest.create_stamp)
                                                     newest = seen;
                                                 });
                                               });
    }
  }
}

int MiddlewareProcess::prepare() {
  const Clock::time_point deadline = Clock::now() + options_.startup_timeout;
  if (!learn_parameters(deadline)) {
    spdlog::error("{}: {} did not tell {} and {} within {} s", options_.node_id, kLabControlName,
                  kPeriodParameter, kActiveIdsParameter, options_.startup_timeout.count());
    return kExitMissing;
  }
  if (signal_.locked([this] { return stop_; })) {
    return kExitGood;
  }
  if (const std::string problem = parameter_problem(parameters_); !problem.empty()) {
    spdlog::error("{}: {}", options_.node_id, problem);
    return kExitBadInput;
  }
  listen_to_vehicles();
  if (options_.logical_time && !wait_for_everybody(deadline)) {
    spdlog::error("{}: not there within {} s: {}", options_.node_id,
                  options_.startup_timeout.count(), who_is_missing());
    return kExitMissing;
  }
  return kExitGood;
}

/// Nothing of the run may be lost, since ticks wait for it.
bool MiddlewareProcess::is_connected() const { return who_is_missing().empty(); }

std::string MiddlewareProcess::who_is_missing() const {
  std::vector<std::string> missing;
  if (ready_writer_.matched() == 0 || trigger_reader_.matched() == 0) {
    missing.emplace_back(kLabControlName);
  }
  if (list_writer_.matched() == 0 || trigger_writer_.matched() == 0 ||
      controllers_that_command() == 0 || ready_reader_.matched() == 0) {
    missing.push_back(controller_name(options_.vehicle_ids.front()));
  }
  for (const auto& [id, reader] : state_readers_) {
    const auto vehicle = vehicles_.find(id);
    const bool commanded = vehicle == vehicles_.end() || vehicle->second->trajectory.matched() > 0;
    if (reader.matched() == 0 || !commanded) {
      missing.push_back(vehicle_name(id));
    }
  }
  return fmt::format("{}", fmt::join(missing, ", "));
}

void MiddlewareProcess::make_timer() {
  LogicalTimer* logical = nullptr;
  if (options_.logical_time) {
    auto timer = std::make_unique<LogicalTimer>(
        parameters_.period(), options_.offset,
        [this](Nanoseconds next_tick) { send_ready(next_tick); }, std::chrono::seconds{1},
        LogicalTimer::patience_for(options_.startup_timeout));
    logical = timer.get();
    timer_ = std::move(timer);
  } else {
    timer_ = std::make_unique<RealTimer>(parameters_.period(), options_.offset);
  }
  signal_.locked([&] {
    timer_in_use_ = timer_.get();
    logical_timer_ = logical;
    if (stop_) {
      timer_->stop();
    }
  });
}

void MiddlewareProcess::send_ready(Nanoseconds next_tick) {
  ready_writer_.write({.source_id = options_.node_id, .next_start = next_tick});
  if (lab_.is_lost(kLabControlName)) {
    lab_control_lost_ = true;
    timer_->stop();
  }
}

// --- the period ---------------------------------------------------------------------------------

void MiddlewareProcess::tick(Nanoseconds t_now) {
  bool knows_vehicles = true;
  if (options_.logical_time) {
    wait_for_states(t_now);
  } else {
    tell_missed_answer();
    knows_vehicles = knows_next_experiment();
  }
  const auto [list, unready, has_been_triggered] = signal_.locked([&] {
    newest_list_ = t_now;
    states_.forget_before(t_now);
    VehicleStateList composed =
        compose_state_list(states_, t_now, parameters_.period(), parameters_.active_ids());
    if (lab_endpoints_) {
      for (const std::int32_t id : parameters_.active_ids()) {
        composed.observations.push_back(observations_[static_cast<std::uint8_t>(id)]);
      }
    }
    std::vector<std::string> unready_controllers;
    for (const std::uint8_t id : options_.vehicle_ids) {
      if (!ready_controllers_.contains(id)) unready_controllers.push_back(controller_name(id));
    }
    return std::tuple{std::move(composed), std::move(unready_controllers), triggered_};
  });
  list_writer_.write(list);
  if (lab_endpoints_ && unready.empty()) lab_endpoints_->goals.forward();
  if (options_.logical_time) return wait_for_answer(t_now);
  if (has_been_triggered) return;
  if (unready.empty() && knows_vehicles) {
    ready_writer_.write({.source_id = middleware_ready_id(options_.vehicle_ids)});
  } else if (!unready.empty() && wait_notice_.is_due()) {
    spdlog::info("{}: waits for {} to be ready", options_.node_id, fmt::join(unready, ", "));
  }
}

void MiddlewareProcess::wait_for_states(Nanoseconds t_now) {
  const std::optional<Nanoseconds> stamp = newest_valid_state_stamp(t_now);
  if (!stamp) {
    return;
  }
  const auto is_here = [&](const auto& vehicle) {
    return states_.holds(vehicle.first, *stamp) || silent_vehicles_.contains(vehicle.first) ||
           vehicle.second.matched() == 0;
  };
  if (signal_.wait_until(Clock::now() + kSilence,
                         [&] { return stop_ || std::ranges::all_of(state_readers_, is_here); })) {
    return;
  }
  const std::set<std::uint8_t> silent = signal_.locked([&] {
    for (const auto& vehicle : state_readers_) {
      if (!is_here(vehicle)) {
        silent_vehicles_.insert(vehicle.first);
      }
    }
    return silent_vehicles_;
  });
  spdlog::warn("{}: vehicles {} have said nothing for {} s and are not waited for any more",
               options_.node_id, fmt::join(silent, ", "), kMessageTimeout / kNanosecondsPerSecond);
}

void MiddlewareProcess::wait_for_answer(Nanoseconds t_now) {
  const auto has_answered = [&](std::uint8_t id) {
    return newest_answers_.at(id) >= t_now || silent_controllers_.contains(id) ||
           local_.is_lost(controller_name(id));
  };
  if (signal_.wait_until(Clock::now() + kSilence, [&] {
        return stop_ || controllers_that_command() == 0 ||
               std::ranges::all_of(options_.vehicle_ids, has_answered);
      })) {
    return;
  }
  for (const std::uint8_t id : options_.vehicle_ids) {
    if (signal_.locked(
            [&] { return !has_answered(id) && silent_controllers_.insert(id).second; })) {
      spdlog::warn("{}: {} has said nothing for {} s and is not waited for any more",
                   options_.node_id, controller_name(id), kMessageTimeout / kNanosecondsPerSecond);
    }
  }
}

void MiddlewareProcess::tell_missed_answer() {
  for (const std::uint8_t id : options_.vehicle_ids) {
    const bool missed = signal_.locked(
        [&] { return triggered_ && newest_list_ != 0 && newest_answers_.at(id) < newest_list_; });
    if (missed && missed_answers_++ == 0) {
      spdlog::warn("{}: {} has missed the list of {} ns", options_.node_id, controller_name(id),
                   newest_list_);
    }
  }
}

// --- the carrier --------------------------------------------------------------------------------

/// On a DDS thread.
void MiddlewareProcess::take(const SystemTrigger& trigger) {
  const bool is_stop = trigger.next_start == kStopSymbol;
  const bool is_first = signal_.locked([this] { return !triggered_; });
  // The lab's controllers are used to all triggers, those of the vehicles' ticks too. Ours needs
  // the first one and the stop, and 50 more a second would cost a run in logical time a good part
  // of its speed. To be carried on before the period learns of the stop: then the carrier ends.
  if (is_stop || is_first || !options_.logical_time || options_.transport == Transport::kLab) {
    mail_.post([&] { to_carry_.emplace_back(trigger); });
  }
  signal_.post([&] {
    between_experiments_ = options_.keep_running && is_stop;
    triggered_ = !between_experiments_;
    if (between_experiments_) {
      ready_controllers_.clear();
      knows_next_ = false;
    }
    stop_symbol_ = stop_symbol_ || (is_stop && !options_.keep_running);
    if (logical_timer_ != nullptr) {
      logical_timer_->on_trigger(trigger.next_start);
    }
  });
  if (is_stop && !options_.keep_running) {
    stop();
  }
}

void MiddlewareProcess::carry_everything() {
  constexpr std::chrono::hours kLong{1};
  while (true) {
    static_cast<void>(mail_.wait_until(Clock::now() + kLong,
                                       [this] { return carrier_ends_ || !to_carry_.empty(); }));
    const auto [mail, ends] = mail_.locked([this] {
      return std::pair{std::exchange(to_carry_, {}), carrier_ends_};
    });
    for (const Carried& item : mail) {
      std::visit([this](const auto& message) { carry_on(message); }, item);
    }
    if (mail.empty() && ends) {
      return;
    }
  }
}

void MiddlewareProcess::carry_on(const SystemTrigger& trigger) { trigger_writer_.write(trigger); }

template <class Command>
void MiddlewareProcess::carry_on(const Command& command) {
  const auto [newest_list, is_kept_back] = signal_.locked([this] {
    return std::pair{newest_list_, between_experiments_ || stop_symbol_};
  });
  const Nanoseconds t_now = options_.logical_time ? newest_list : real_time_now();
  CommandVerdict verdict;
  if constexpr (std::is_same_v<Command, TrajectoryCommand>) {
    verdict = check_command(command, t_now, newest_list, options_.vehicle_ids);
  } else {
    verdict = check_header(command.vehicle_id, command.create_stamp, t_now, newest_list,
                           options_.vehicle_ids);
  }
  if (verdict.forward && !is_kept_back) {
    vehicles_.at(command.vehicle_id)->write(command);
  }
  tell_faults(verdict, command.vehicle_id);
  signal_.post([&] {
    const auto answer = newest_answers_.find(command.vehicle_id);
    if (answer == newest_answers_.end()) return;  // of somebody else's controller
    answer->second = std::max(answer->second, command.create_stamp);
    silent_controllers_.erase(command.vehicle_id);
  });
}

void MiddlewareProcess::tell_faults(const CommandVerdict& verdict, std::uint8_t vehicle_id) {
  for (const CommandFault fault : verdict.faults) {
    if (told_faults_.insert(fault).second) {
      spdlog::warn("{}: command of {}: {}{} (told once)", options_.node_id,
                   controller_name(vehicle_id), to_string(fault),
                   verdict.forward ? "" : "; not forwarded");
    }
  }
}

}  // namespace hlc
