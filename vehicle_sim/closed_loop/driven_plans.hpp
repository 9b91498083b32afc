#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "hlc_bridge/messages/messages.hpp"
#include "planner/coordination/messages.hpp"
#include "planner/coordination/plan.hpp"
#include "planner/coordination/report.hpp"
#include "vehicle_sim/closed_loop/received_commands.hpp"
#include "vehicle_sim/closed_loop/standing_areas.hpp"
#include "vehicle_sim/closed_loop/violation.hpp"

namespace hlc::closed_loop {

/// Which plan each vehicle truly drives: the one whose command it follows. What is checked:
///
/// * **driven**: whenever a vehicle changes over to another agreed plan, it is free of what the
///   others drive from then on, until both stand. A plan that is re-anchored where a vehicle
///   stands has been agreed by nobody: of that the footprints are checked. Once the plan of a
///   vehicle has run out, the vehicle stands where its controller announces.
/// * **commands**: a vehicle follows the newest command that it has received and that is valid; and
///   its controller has sent it all that it needs to drive the plan to its end, and, in real time,
///   nothing while it does not see it (rule 5 of plan_in_force.hpp).
///
/// **The limits of what controllers can promise** (plan_in_force.hpp). A controller is *mistaken*
/// about its vehicle if it publishes traffic while the vehicle has not received the plan in force,
/// which was agreed in a step before, although it sees the vehicle, and reports no deviation: the
/// others rely on a plan that is not driven. A vehicle is *out of reach*
///   * while its controller is mistaken, from the second step after the first plan that it has not
///     received;
///   * while it has dropped its command before the end of the plan, since what was sent has not
///     arrived, or the controller was stopped between a command and its last copy;
///   * when it has received a plan that was sent in time only after that had begun (with its own
///     command, or with that of a later plan, which continues it), and has changed over to it late,
///     that is on a way that nobody could know: until its controller's next step, and longer if it
///     is then seen off the plan (kDeviation in the next two steps). The first of these steps may
///     not show it yet, since states are older than their list: if the second one is overdue, since
///     its list is lost, the vehicle is out of reach until it begins;
///   * when its process dies;
/// and for `afterwards` longer, while others may drive what they have agreed to meanwhile. Only
/// what the vehicle has not received counts: commands that it has it must follow.
class DrivenPlans {
 public:
  /// @param standing  as in PlansCheck
  DrivenPlans(std::size_t horizon_steps, Nanoseconds period,
              const StandingAreas* standing = nullptr);

  /// A plan and two steps more.
  [[nodiscard]] Nanoseconds afterwards() const { return (horizon_steps_ + 2) * period_; }

  void predicted(const coordination::Prediction& prediction) {
    cars_[prediction.vehicle].predicted = prediction;
  }
  /// @param is_seen  the controller sees its vehicle in this step, or cannot know it from its lists
  void published(const coordination::Traffic& traffic, bool is_seen = true);
  /// @param at  true time
  void commanded(const TrajectoryCommand& command, Nanoseconds at, Violations& violations);
  /// What was commanded before in the same step is of the plan in force after it.
  void reported(const coordination::Report& report, const coordination::Plan* in_force);
  void received(const TrajectoryCommand& command);
  /// @param follows  create_stamp of the command that is followed; 0: none
  void driven(VehicleId vehicle, Nanoseconds tick, Nanoseconds follows, Violations& violations);
  void died(VehicleId vehicle, Nanoseconds at);
  /// Another controller of the vehicle begins.
  void controller_started(VehicleId vehicle) { cars_[vehicle].is_seen = true; }
  /// Before its report nobody knows which plan it has commanded.
  void controller_died(VehicleId vehicle) {
    Car& car = cars_[vehicle];
    for (Sent& sent : car.sent) {
      if (!sent.plan) sent.plan = std::make_shared<const Agreed>(Agreed{.number = car.num_agreed});
    }
  }
  /// Its controller's process has ended or is suspended. @param at  true time
  void controller_stopped(VehicleId vehicle, Nanoseconds at) {
    Car& car = cars_[vehicle];
    const bool is_stopped = !car.sent.empty() && car.controller_stopped >= car.sent.back().at;
    if (!is_stopped) car.controller_stopped = at;
  }

  /// The vehicle has received the plan that was agreed last.
  [[nodiscard]] bool has_plan_in_force(VehicleId vehicle) const {
    const auto car = cars_.find(vehicle);
    return car == cars_.end() || has_newest_plan(car->second);
  }
  [[nodiscard]] bool is_out_of_reach(VehicleId vehicle, Nanoseconds at) const;

 private:
  /// A plan as its vehicle has announced it, or to stand where it stands.
  struct Agreed {
    std::uint64_t number{};
    Nanoseconds begin{};
    StepIndex end;  ///< with the last pose, the identity of a plan
    Pose last_pose;
    std::optional<coordination::OccupiedAreas> areas;  ///< none: not known to anybody
    bool is_anchored{};
  };
  using AgreedPlan = std::shared_ptr<const Agreed>;
  struct Sent {
    Nanoseconds create{};
    Nanoseconds at{};
    Nanoseconds usable_until{};  ///< with the copies that have been sent
    std::size_t copies{};        ///< sent so far
    AgreedPlan plan;
  };
  struct LateChange {
    Nanoseconds at{};           ///< tick of the last one; 0: none
    std::size_t steps_begun{};  ///< by the controller since then
    std::size_t steps_ended{};
  };
  struct Car {
    std::optional<coordination::Prediction> predicted;
    std::optional<coordination::OccupiedAreas> announced;  ///< in its last traffic
    std::optional<coordination::OccupiedAreas> stands;     ///< announced after the driven plan
    AgreedPlan agreed{std::make_shared<const Agreed>()};
    std::uint64_t num_agreed{};
    StepIndex missed_since;  ///< step of the first plan that the vehicle has not received
    bool is_mistaken{};
    bool is_seen{true};     ///< by its controller, in its last step
    std::deque<Sent> sent;  ///< the newest last
    ReceivedCommands received;
    Nanoseconds controller_stopped{};  ///< for the first time after what it sent last
    Nanoseconds follows{};
    AgreedPlan driven;
    LateChange late_change;
    Nanoseconds out_of_reach_until{};
  };

  static void note_standing(Car& car, const coordination::Report& report);
  [[nodiscard]] static AgreedPlan plan_of(const Car& car, Nanoseconds create);
  [[nodiscard]] static bool has_newest_plan(const Car& car);
  [[nodiscard]] static AgreedPlan kept_plan(const Car& car, const coordination::Report& report,
                                            const coordination::Plan& in_force);
  [[nodiscard]] static bool is_change_late(const Car& car, const AgreedPlan& plan,
                                           Nanoseconds tick);
  void note_observation(Car& car, const coordination::Report& report) const;
  [[nodiscard]] bool is_unseen_after_change(const Car& car, Nanoseconds tick) const;
  [[nodiscard]] bool has_dropped_plan(const Car& car, Nanoseconds tick) const;
  [[nodiscard]] bool has_all_that_was_sent(const Car& car) const;
  void check_drop(VehicleId vehicle, Car& car, Nanoseconds tick, Violations& violations);
  [[nodiscard]] bool is_checked(VehicleId vehicle, const Car& car, Nanoseconds tick) const;
  void check_order(VehicleId vehicle, Car& car, Nanoseconds tick, Violations& violations);
  [[nodiscard]] static const coordination::OccupiedAreas& areas_of(const Car& car);
  [[nodiscard]] bool meet(const coordination::OccupiedAreas& areas, VehicleId other, const Car& its,
                          StepIndex from) const;
  void check_pairs(VehicleId vehicle, Nanoseconds tick, Violations& violations);

  std::size_t horizon_steps_;
  Nanoseconds period_;
  std::size_t num_copies_;  ///< of each command
  const StandingAreas* standing_;
  std::map<VehicleId, Car> cars_;
  std::set<std::pair<VehicleId, VehicleId>> met_;
  std::set<VehicleId> off_command_;
};

}  // namespace hlc::closed_loop
