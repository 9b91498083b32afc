#pragma once

#include <algorithm>
#include <functional>
#include <map>
#include <optional>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "hlc_bridge/lab_control/logical_run.hpp"
#include "hlc_bridge/messages/node_names.hpp"

namespace hlc::lab_control {

/// Names of all timers of a run.
inline std::set<std::string> timers_of(const std::vector<std::uint8_t>& vehicle_ids) {
  std::set<std::string> names;
  for (const std::uint8_t id : vehicle_ids) {
    names.insert({vehicle_name(id), middleware_name(id)});
  }
  return names;
}

/// The processes of a run in logical time as far as the lab control sees them, run in random order:
/// at any moment one of the processes that can do something does it. One of them may die at a
/// chosen time.
///
/// They keep the run protocol: a vehicle waits for the answer to the last list, a middleware for
/// its controller's answer, a controller for the other controllers. No process waits for
/// one that it has lost. When no process can act, 10 s of wall time pass, and the dead process is
/// detected.
class SimulatedLab {
 public:
  enum class Dying { kVanishes, kHangs };  ///< its participant goes, or stays without an answer

  struct Fault {
    std::string process;
    Nanoseconds time{};  ///< of the run
    Dying dying{Dying::kVanishes};
  };

  SimulatedLab(LabRunSettings settings, unsigned seed)
      : settings_{settings}, run_{settings}, random_{seed} {
    for (const std::uint8_t id : settings.vehicle_ids) {
      vehicles_[id];
      middlewares_[id].deadline = kListOffset;
      controllers_[id];
      for (const auto& name : {vehicle_name(id), middleware_name(id), controller_name(id)}) {
        alive_.insert(name);
      }
    }
  }

  void set_fault(const Fault& fault) { fault_ = fault; }
  /// First step in which the controllers are not standby; none: never.
  void set_first_step(std::optional<std::uint64_t> step) { first_step_ = step; }
  void interrupt_at(Nanoseconds time) { interrupt_at_ = time; }

  /// Lets everything happen until the run has finished; false if it does not get there.
  bool run() {
    for (std::size_t i = 0; i < 1'000'000; ++i) {
      run_.presence(alive_, lost_);
      run_.trigger_readers(timers_of(settings_.vehicle_ids));
      perform(run_.advance(wall_));
      if (run_.finished()) {
        return true;
      }
      if (interrupt_at_ && latest_ >= *interrupt_at_) {
        run_.interrupt();
        interrupt_at_.reset();
        continue;
      }
      die_if_due();
      if (!act() && !pass_time()) {
        return false;
      }
    }
    return false;
  }

  [[nodiscard]] const LabRunResult& result() const { return run_.result(); }
  [[nodiscard]] const std::vector<Nanoseconds>& released() const { return released_; }
  [[nodiscard]] const std::vector<std::string>& violations() const { return violations_; }
  [[nodiscard]] std::optional<Nanoseconds> death_reported_at() const { return death_reported_at_; }
  [[nodiscard]] std::optional<Nanoseconds> stopped_at() const { return stopped_at_; }
  [[nodiscard]] Nanoseconds wall() const { return wall_; }
  [[nodiscard]] std::uint64_t last_report(std::uint8_t id) const {
    return controllers_.at(id).reported.value_or(0);
  }

 private:
  struct Vehicle {
    Nanoseconds deadline{};
    bool is_ready{};  ///< ready for `deadline`
    bool released{};  ///< trigger for `deadline` has come
    std::optional<Nanoseconds> command;
    int braking_ticks{};
    bool gone{};
  };
  struct Middleware {
    Nanoseconds deadline{};
    bool is_ready{};
    bool released{};
    bool list_written{};
    bool gone{};
  };
  struct Controller {
    std::optional<std::uint64_t> list;      ///< step of the newest list
    std::optional<std::uint64_t> answered;  ///< command sent
    std::optional<std::uint64_t> reported;
    bool gone{};
  };
  using Action = std::function<void()>;

  [[nodiscard]] bool acts(const std::string& name) const { return name != dead_; }
  [[nodiscard]] bool is_known_lost(const std::string& name) const {
    return known_lost_.count(name) != 0;
  }

  void perform(const LabRunActions& actions) {
    if (!actions.deaths.empty() && !death_reported_at_) {
      death_reported_at_ = latest_;
    }
    for (const Nanoseconds trigger : actions.triggers) {
      if (trigger == kStopSymbol) {
        stop();
      } else {
        release(trigger);
      }
    }
  }

  void stop() {
    stopped_at_ = latest_;
    for (auto& [id, middleware] : middlewares_) {
      leave(middleware_name(id), middleware.gone);
      leave(controller_name(id), controllers_[id].gone);
    }
  }

  void leave(const std::string& name, bool& gone) {
    gone = true;
    if (acts(name)) {
      alive_.erase(name);
      lost_.insert(name);
      known_lost_.insert(name);
    }
  }

  void release(Nanoseconds tick) {
    if (released_.empty() || tick != released_.back()) {
      check_release(tick);
      released_.push_back(tick);
      latest_ = tick;
    }
    for (auto& [id, vehicle] : vehicles_) {
      vehicle.released |= vehicle.is_ready && vehicle.deadline == tick;
    }
    for (auto& [id, middleware] : middlewares_) {
      middleware.released |= middleware.is_ready && middleware.deadline == tick;
    }
  }

  void expect(bool good, const std::string& what) {
    if (!good) {
      violations_.push_back("at " + std::to_string(latest_) + ": " + what);
    }
  }

  void check_release(Nanoseconds tick) {
    expect(released_.empty() || tick > released_.back(), "ticks go back");
    const bool known = run_.phase() != LabRun::Phase::kGathering;
    for (const auto& [id, vehicle] : vehicles_) {
      const bool waited_for = !vehicle.gone && acts(vehicle_name(id));
      expect(!waited_for || (vehicle.is_ready && !vehicle.released && vehicle.deadline >= tick),
             vehicle_name(id) + " has not answered before tick " + std::to_string(tick));
    }
    for (const auto& [id, middleware] : middlewares_) {
      const bool waited_for = !middleware.gone && acts(middleware_name(id));
      expect(!waited_for ||
                 (middleware.is_ready && !middleware.released && middleware.deadline >= tick),
             middleware_name(id) + " has not answered before tick " + std::to_string(tick));
    }
    for (const auto& [id, controller] : controllers_) {
      const bool waited_for = !controller.gone && acts(controller_name(id)) &&
                              acts(middleware_name(id)) && tick > kListOffset;
      if (waited_for) {
        const std::uint64_t step = (tick - 2) / settings_.period;
        expect(controller.reported && *controller.reported >= step,
               controller_name(id) + " has not reported before tick " + std::to_string(tick));
      }
    }
    expect(known, "tick before the start");
  }

  void die_if_due() {
    if (fault_ && dead_.empty() && latest_ >= fault_->time && !released_.empty() &&
        random_() % 4 == 0) {
      dead_ = fault_->process;
    }
  }

  /// One of the possible actions, chosen at random; false if there is none.
  bool act() {
    std::vector<Action> possible;
    for (auto& [id, vehicle] : vehicles_) {
      add_vehicle_actions(id, vehicle, possible);
    }
    for (auto& [id, middleware] : middlewares_) {
      add_middleware_actions(id, middleware, possible);
    }
    for (auto& [id, controller] : controllers_) {
      add_controller_actions(id, controller, possible);
    }
    if (possible.empty()) {
      return false;
    }
    wall_ += 100'000;
    possible[random_() % possible.size()]();
    return true;
  }

  void publish_ready(const std::string& name, Nanoseconds deadline, bool& is_ready) {
    run_.ready({name, deadline});
    is_ready = true;
    if (random_() % 20 == 0) {
      run_.ready({name, deadline});  // a repetition
    }
  }

  void add_vehicle_actions(std::uint8_t id, Vehicle& vehicle, std::vector<Action>& possible) {
    const std::string name = vehicle_name(id);
    if (!acts(name) || vehicle.gone) {
      return;
    }
    if (!vehicle.is_ready) {
      possible.push_back([this, name, &vehicle] {
        if (vehicle.braking_ticks == 50) {
          leave(name, vehicle.gone);
        } else {
          publish_ready(name, vehicle.deadline, vehicle.is_ready);
        }
      });
      return;
    }
    const auto list = last_list_before(vehicle.deadline, settings_.period);
    const bool has_command = stopped_at_ || !list || is_known_lost(middleware_name(id)) ||
                             is_known_lost(controller_name(id)) ||
                             (vehicle.command && *vehicle.command >= *list);
    if (vehicle.released && has_command) {
      possible.push_back([this, &vehicle] {
        vehicle.deadline += kVehiclePeriod;
        vehicle.is_ready = vehicle.released = false;
        vehicle.braking_ticks += stopped_at_ ? 1 : 0;
      });
    }
  }

  void add_middleware_actions(std::uint8_t id, Middleware& middleware,
                              std::vector<Action>& possible) {
    const std::string name = middleware_name(id);
    if (!acts(name) || middleware.gone) {
      return;
    }
    if (!middleware.is_ready) {
      possible.push_back([this, name, &middleware] {
        publish_ready(name, middleware.deadline, middleware.is_ready);
      });
      return;
    }
    if (!middleware.released) {
      return;
    }
    const std::uint64_t step = middleware.deadline / settings_.period;
    if (!middleware.list_written) {
      possible.push_back([this, id, step, &middleware] {
        middleware.list_written = true;
        controllers_[id].list = step;
      });
    } else if (controllers_[id].answered == step || is_known_lost(controller_name(id))) {
      possible.push_back([this, id, &middleware] {
        vehicles_[id].command = middleware.deadline;
        middleware.deadline += settings_.period;
        middleware.is_ready = middleware.released = middleware.list_written = false;
      });
    }
  }

  void add_controller_actions(std::uint8_t id, Controller& controller,
                              std::vector<Action>& possible) {
    const std::string name = controller_name(id);
    if (!acts(name) || controller.gone) {
      return;
    }
    if (is_known_lost(middleware_name(id))) {
      possible.push_back([this, name, &controller] { leave(name, controller.gone); });
      return;
    }
    if (controller.list && controller.answered != controller.list && others_are_at(id)) {
      possible.push_back([&controller] { controller.answered = controller.list; });
    }
    if (controller.answered && controller.reported != controller.answered) {
      possible.push_back([this, id, &controller] { report(id, controller); });
    }
  }

  [[nodiscard]] bool others_are_at(std::uint8_t id) const {
    const std::uint64_t step = controllers_.at(id).list.value();
    return std::all_of(controllers_.begin(), controllers_.end(), [&](const auto& other) {
      return other.second.list >= step || is_known_lost(controller_name(other.first)) ||
             is_known_lost(middleware_name(other.first));
    });
  }

  void report(std::uint8_t id, Controller& controller) {
    ReportRecord record;
    record.report.vehicle = VehicleId{id};
    record.report.step = StepIndex{*controller.answered};
    const bool started = first_step_ && *controller.answered >= *first_step_;
    record.report.status =
        started ? coordination::StepStatus::kPlanned : coordination::StepStatus::kStandby;
    controller.reported = controller.answered;
    run_.report(record);
  }

  /// No process can act: the peers' timeouts expire, later the lab control's.
  bool pass_time() {
    if (!dead_.empty() && known_lost_.insert(dead_).second) {
      wall_ += kMessageTimeout;
      if (fault_->dying == Dying::kVanishes) {
        alive_.erase(dead_);
        lost_.insert(dead_);
      }
      return true;
    }
    if (run_.wake_up() == ~Nanoseconds{0} || run_.wake_up() <= wall_) {
      return false;
    }
    wall_ = run_.wake_up();
    return true;
  }

  LabRunSettings settings_;
  LogicalRun run_;
  std::mt19937 random_;
  std::map<std::uint8_t, Vehicle> vehicles_;
  std::map<std::uint8_t, Middleware> middlewares_;
  std::map<std::uint8_t, Controller> controllers_;
  std::optional<Fault> fault_;
  std::optional<std::uint64_t> first_step_{5};
  std::optional<Nanoseconds> interrupt_at_;
  std::string dead_;
  std::set<std::string> alive_;
  std::set<std::string> lost_;
  std::set<std::string> known_lost_;
  Nanoseconds wall_{1'000};
  Nanoseconds latest_{};
  std::vector<Nanoseconds> released_;
  std::vector<std::string> violations_;
  std::optional<Nanoseconds> death_reported_at_;
  std::optional<Nanoseconds> stopped_at_;
};

}  // namespace hlc::lab_control
