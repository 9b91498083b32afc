#include "vehicle_sim/apps/vehicle_process.hpp"

#include <fmt/ranges.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <set>
#include <utility>
#include <variant>

#include "hlc_bridge/messages/node_names.hpp"
#include "hlc_bridge/messages/time_grid.hpp"

namespace hlc {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kRequestInterval{100};
constexpr std::chrono::milliseconds kLookInterval{500};
constexpr std::chrono::nanoseconds kSilence{kMessageTimeout};
/// After this many missed ticks (10 s) the vehicle stands anyway.
constexpr Nanoseconds kMostMissedTicks = 500;

const char* reason(FollowerStatus status) {
  switch (status) {
    case FollowerStatus::kFollowing:
      return "it follows";
    case FollowerStatus::kNoCommand:
      return "no usable command";
    case FollowerStatus::kNotFollowable:
      return "the command is empty, malformed, too short or too wild";
    case FollowerStatus::kTooFar:
      return "too far from its reference";
    case FollowerStatus::kNoEstimate:
      return "its own state is not finite";
  }
  return "";
}

}  // namespace

VehicleProcess::VehicleProcess(VehicleProcessOptions options)
    : options_(std::move(options)),
      name_(vehicle_name(options_.vehicle.vehicle_id)),
      middleware_(middleware_name(options_.vehicle.vehicle_id)),
      controller_(controller_name(options_.vehicle.vehicle_id)),
      vehicle_(options_.vehicle),
      recorder_(options_.record_file.empty()
                    ? std::nullopt
                    : std::optional<DriveRecorder>(std::in_place, options_.record_file,
                                                   options_.append_record)),
      // The lab's controllers do not answer before the start. Ours is heard soon enough.
      gave_up_waiting_(options_.transport == Transport::kLab),
      timer_(make_timer()),
      lab_({.name = name_,
            .domain_id = options_.lab_domain,
            .role = DomainRole::kLab,
            .transport = options_.transport,
            .logical_time = options_.logical_time,
            .discovery_server = options_.discovery_server,
            .version = options_.version,
            .on_loss = [this](const std::string& line) { spdlog::warn("{}: {}", name_, line); }},
           [this] { signal_.notify(); }),
      state_writer_(lab_, topics::vehicle_state(options_.vehicle.vehicle_id),
                    [this] { signal_.notify(); }),
      ready_writer_(lab_, topics::ready_status(), [this] { signal_.notify(); }),
      request_writer_(lab_, topics::parameter_request()),
      command_reader_(
          lab_, topics::vehicle_command(options_.vehicle.vehicle_id),
          [this](const TrajectoryCommand& command) { take(command); },
          [this] { signal_.notify(); }),
      parameter_reader_(lab_, topics::parameter(),
                        [this](const Parameter& parameter) {
                          signal_.post([&] { parameters_.take(parameter); });
                        }),
      trigger_reader_(
          lab_, topics::system_trigger(),
          [this](const SystemTrigger& trigger) {
            if (trigger.next_start == kStopSymbol) {
              signal_.post([this] { stop_symbol_ = true; });
            } else if (logical_timer_ != nullptr) {
              logical_timer_->on_trigger(trigger.next_start);
            }
          },
          [this] { signal_.notify(); }) {
  if (options_.transport == Transport::kLab) {
    lab_endpoints_ = std::make_unique<LabEndpoints>(*this);
  }
}

VehicleProcess::~VehicleProcess() = default;

struct VehicleProcess::LabEndpoints {
  explicit LabEndpoints(VehicleProcess& process)
      : observation_writer{process.lab_,
                           topics::vehicle_observation(process.options_.vehicle.vehicle_id)},
        path_tracking_reader{reader<PathTrackingCommand>(process)},
        speed_curvature_reader{reader<SpeedCurvatureCommand>(process)},
        direct_reader{reader<DirectCommand>(process)} {}

  template <class Received>
  static Reader<Received> reader(VehicleProcess& process) {
    return Reader<Received>{process.lab_,
                            topics::vehicle_command<Received>(process.options_.vehicle.vehicle_id),
                            [&process](const Received& command) { process.take(command); }};
  }

  Writer<VehicleObservation> observation_writer;
  Reader<PathTrackingCommand> path_tracking_reader;
  Reader<SpeedCurvatureCommand> speed_curvature_reader;
  Reader<DirectCommand> direct_reader;
};

/// On a DDS thread.
template <class Received>
void VehicleProcess::take(const Received& command) {
  signal_.post([&] {
    newest_answer_ = std::max(newest_answer_, command.create_stamp);
    gave_up_waiting_ = false;
    inbox_.emplace_back(command);
  });
}

std::unique_ptr<Timer> VehicleProcess::make_timer() {
  if (!options_.logical_time) {
    return std::make_unique<RealTimer>(kVehiclePeriod, 0);
  }
  auto timer = std::make_unique<LogicalTimer>(
      kVehiclePeriod, 0, [this](Nanoseconds next_tick) { send_ready(next_tick); },
      std::chrono::seconds{1}, LogicalTimer::patience_for(options_.startup_timeout));
  logical_timer_ = timer.get();
  return timer;
}

void VehicleProcess::stop() {
  signal_.post([this] { stop_ = true; });
  timer_->stop();
}

int VehicleProcess::run() {
  const Pose& pose = options_.vehicle.start;
  spdlog::info("{}: at ({:.3f} m, {:.3f} m, {:.3f} rad)", name_, pose.x_m, pose.y_m,
               pose.heading_rad);
  if (options_.logical_time) {
    const int problem = prepare();
    if (problem != kExitGood || is_ending_now()) {
      return problem;
    }
  }
  std::optional<Nanoseconds> t_now = timer_->wait_next();
  while (t_now && tick(*t_now)) {
    if (!options_.logical_time) watch_lab_control(*t_now);
    t_now = timer_->wait_next();
  }
  if (logical_timer_ != nullptr && logical_timer_->has_given_up()) {
    spdlog::error("{}: {} hangs: no trigger comes any more", name_, kLabControlName);
    return kExitDied;
  }
  if (lab_control_lost_ && !is_stopping_ && !is_ending_now()) {
    spdlog::error("{}: {} is gone", name_, kLabControlName);
    return kExitDied;
  }
  return kExitGood;
}

// --- start in logical time ----------------------------------------------------------------------

bool VehicleProcess::learn_parameters(Clock::time_point deadline) {
  return signal_.repeat_until(
      deadline, kRequestInterval, [this] { return is_ending() || parameters_.complete(); },
      [this] {
        const auto missing = signal_.locked([this] { return parameters_.missing(); });
        for (const std::string& name : missing) request_writer_.write({.name = name});
        if (wait_notice_.is_due()) {
          spdlog::info("{}: waits for {} to tell {}", name_, kLabControlName,
                       fmt::join(missing, ", "));
        }
      });
}

bool VehicleProcess::wait_for_everybody(Clock::time_point deadline) {
  return signal_.repeat_until(
      deadline, kLookInterval, [this] { return is_ending() || is_connected(); },
      [this] {
        if (wait_notice_.is_due()) spdlog::info("{}: waits for {}", name_, who_is_missing());
      });
}

/// A state or a command of the run that nobody hears is lost, and then a tick would wait for it.
/// On the lab's transport, where the lab's own middleware bears another name: of anybody's.
bool VehicleProcess::is_connected() const {
  if (options_.transport == Transport::kLab) {
    return state_writer_.matched() > 0 && command_reader_.matched() > 0 &&
           ready_writer_.matched() > 0 && trigger_reader_.matched() > 0;
  }
  const std::set<std::string> hearers = state_writer_.matched_names();
  const bool all_middlewares_hear =
      std::ranges::all_of(parameters_.active_ids(), [&](std::int32_t id) {
        return hearers.contains(middleware_name(static_cast<std::uint8_t>(id)));
      });
  return all_middlewares_hear && command_reader_.matched_names().contains(middleware_) &&
         ready_writer_.matched() > 0 && trigger_reader_.matched() > 0;
}

std::string VehicleProcess::who_is_missing() const {
  std::vector<std::string> missing;
  if (ready_writer_.matched() == 0 || trigger_reader_.matched() == 0) {
    missing.emplace_back(kLabControlName);
  }
  const std::set<std::string> hearers = state_writer_.matched_names();
  for (const std::int32_t id : parameters_.active_ids()) {
    const std::string middleware = middleware_name(static_cast<std::uint8_t>(id));
    const bool commands =
        middleware != middleware_ || command_reader_.matched_names().contains(middleware);
    if (!hearers.contains(middleware) || !commands) {
      missing.push_back(middleware);
    }
  }
  return fmt::format("{}", fmt::join(missing, ", "));
}

int VehicleProcess::prepare() {
  const Clock::time_point deadline = Clock::now() + options_.startup_timeout;
  if (!learn_parameters(deadline)) {
    spdlog::error("{}: {} did not tell {} and {} within {} s", name_, kLabControlName,
                  kPeriodParameter, kActiveIdsParameter, options_.startup_timeout.count());
    return kExitMissing;
  }
  if (is_ending_now()) {
    return kExitGood;
  }
  if (parameters_.period() == 0) {
    spdlog::error("{}: {} = 0, must be more", name_, kPeriodParameter);
    return kExitBadInput;
  }
  if (std::ranges::count(parameters_.active_ids(), options_.vehicle.vehicle_id) == 0) {
    spdlog::error("{}: --vehicle_id={} is not among the {}: {}", name_, options_.vehicle.vehicle_id,
                  kActiveIdsParameter, fmt::join(parameters_.active_ids(), ", "));
    return kExitBadInput;
  }
  if (!wait_for_everybody(deadline)) {
    spdlog::error("{}: not there within {} s: {}", name_, options_.startup_timeout.count(),
                  who_is_missing());
    return kExitMissing;
  }
  return kExitGood;
}

void VehicleProcess::send_ready(Nanoseconds next_tick) {
  ready_writer_.write({.source_id = name_, .next_start = next_tick});
  if (lab_.is_lost(kLabControlName)) {
    lab_control_lost_ = true;
    timer_->stop();
  }
}

/// Real time: the plan is driven to its end before the vehicle leaves.
void VehicleProcess::watch_lab_control(Nanoseconds t_now) {
  if (options_.keep_running || !lab_.is_lost(kLabControlName)) {
    lab_control_lost_at_.reset();
  } else if (!lab_control_lost_at_) {
    lab_control_lost_at_ = t_now;
  } else if (t_now > *lab_control_lost_at_ + kVehicleStays) {
    lab_control_lost_ = true;
    timer_->stop();
  }
}

// --- one tick -----------------------------------------------------------------------------------

bool VehicleProcess::tick(Nanoseconds t_now) {
  if (options_.logical_time) {
    wait_for_answer(t_now);
  } else {
    make_up_for_missed_ticks(t_now);
  }
  const bool begins_to_brake =
      signal_.locked([this] { return std::exchange(stop_symbol_, false); });
  if (begins_to_brake) {
    spdlog::info("{}: stop", name_);
    vehicle_.brake();
    is_stopping_ = true;
  }
  const SimulatedVehicle::Tick done = step(t_now);
  state_writer_.write(done.state);
  if (lab_endpoints_) lab_endpoints_->observation_writer.write(done.observation);
  tell_why_it_stops(done);
  last_tick_ = t_now;
  if (is_stopping_ && !vehicle_.is_braking()) {
    is_stopping_ = false;
    return options_.keep_running;
  }
  return true;
}

bool VehicleProcess::is_answered(Nanoseconds list) const {
  return is_ending() || newest_answer_ >= list || gave_up_waiting_ || lab_.is_lost(middleware_) ||
         lab_.is_lost(controller_);
}

void VehicleProcess::wait_for_answer(Nanoseconds t_now) {
  const std::optional<Nanoseconds> list = last_list_before(t_now, parameters_.period());
  if (!list || vehicle_.is_braking() ||
      signal_.wait_until(Clock::now() + kSilence, [&] { return is_answered(*list); })) {
    return;
  }
  spdlog::warn("{}: no answer to the list of {} ns within {} s; waits no more", name_, *list,
               kMessageTimeout / kNanosecondsPerSecond);
  signal_.post([this] { gave_up_waiting_ = true; });
}

void VehicleProcess::make_up_for_missed_ticks(Nanoseconds t_now) {
  if (!last_tick_) {
    return;
  }
  const Nanoseconds earliest = t_now - std::min(t_now, kMostMissedTicks * kVehiclePeriod);
  for (Nanoseconds t = std::max(*last_tick_ + kVehiclePeriod, earliest); t < t_now;
       t += kVehiclePeriod) {
    step(t);
  }
}

SimulatedVehicle::Tick VehicleProcess::step(Nanoseconds t_now) {
  for (Command& command : signal_.locked([this] { return std::exchange(inbox_, {}); })) {
    std::visit([this](auto& received) { vehicle_.receive(std::move(received)); }, command);
  }
  SimulatedVehicle::Tick done = vehicle_.tick(t_now);
  if (recorder_) {
    recorder_->write(done.driven);
  }
  return done;
}

void VehicleProcess::tell_why_it_stops(const SimulatedVehicle::Tick& done) {
  if (last_status_ == FollowerStatus::kFollowing && done.status != last_status_ && !is_stopping_) {
    spdlog::warn("{}: stops at {} ns: {}", name_, done.driven.t, reason(done.status));
  }
  last_status_ = done.status;
}

}  // namespace hlc
