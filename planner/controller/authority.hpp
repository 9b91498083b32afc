#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <vector>

#include "planner/controller/route_tracker.hpp"
#include "planner/controller/shared_step.hpp"
#include "planner/coordination/messages.hpp"
#include "planner/coordination/plan.hpp"
#include "planner/right_of_way/conflict_map.hpp"
#include "planner/right_of_way/grant.hpp"
#include "planner/right_of_way/way_on.hpp"

namespace hlc::controller {

/// How far one vehicle may go on the shared road, by the right of way among all (grant.hpp). A
/// value; the map is shared.
///
/// A vehicle that has stood for kPatience_steps with road of its own in front of it, also in a
/// conflict cell, gives that road back, and if that has conflict cells its waiting starts again:
/// something that the cells do not know of is in its way, perhaps a vehicle that waits for the same
/// road and stands some millimetres too near to be passed.
///
/// A vehicle that declines road, so that others get on (way_on.hpp), begins to wait again, too: the
/// others come first.
///
/// The end of the authority is a limit of planning, on top of everything that keeps plans apart:
/// whatever the others hold or announce, no plan meets another's. It is never nearer than the end
/// of the plan in force. Where the road is wider than the lane a search finds plans around the bar
/// behind it, such as to get away from all places where a missing vehicle can be: they are dropped
/// (`reaches`), for one that ends nearer or the plan in force. A car that stands askew in a bend
/// may reach into the bar behind the end; it then finds no plan until more is granted to it.
class Authority {
 public:
  static constexpr std::uint32_t kPatience_steps = 25;

  /// @param order  in which authorities are extended, the same for all vehicles
  explicit Authority(std::shared_ptr<const right_of_way::ConflictMap> map,
                     const right_of_way::GrantOrder& order = right_of_way::kLongestWait);

  /// The vehicle holds nothing any longer: it was moved to another place.
  void release() { has_place_ = false; }
  /// Starts a step: the vehicle's place, by its plan. At one that is more than `reach_m` from the
  /// former one along the route it holds nothing any longer.
  /// @param reach_m  as for RouteTracker::project
  void begin_step(const coordination::Plan& in_force, StepIndex now, const RouteTracker& tracker,
                  double reach_m);
  /// For this step's traffic. @pre begin_step
  [[nodiscard]] const coordination::LaneClaim& claim() const { return claim_; }

  /// Keeps what others claim in this step, for steps in which one of them is missing.
  /// @pre begin_step
  /// @param others  of which a claim on the same map has been received in this step
  void receive(std::span<const coordination::Traffic* const> others);

  /// Whether a claim of the vehicle has ever been received.
  [[nodiscard]] bool knows(VehicleId vehicle) const { return known_.contains(vehicle); }

  /// Takes what is granted to this vehicle, given what all others hold; where one is missing that
  /// may take the same, only what nobody else can take (right_of_way::cautious_grant).
  /// @param others     as for `receive`, in the same step
  /// @param missing    known vehicles that were not received in this step
  /// @param blocked    areas of others that hold nothing, those of one vehicle together
  /// @param step_m     the longest way of a vehicle in a step
  void extend(VehicleId own, std::span<const coordination::Traffic* const> others,
              std::span<const VehicleId> missing, std::span<const right_of_way::Blocked> blocked,
              double step_m, SharedStep& shared);

  /// The authority of another vehicle with this claim in its traffic, after the grants of
  /// `receiver`: grants are the same in all controllers that received the same.
  void resume(const coordination::LaneClaim& claim, VehicleId vehicle, const Authority& receiver);

  /// If the end limits planning: vehicles that hold or block what would be granted next, for which
  /// it is reserved, or that would not get on if this one took it. @pre extend
  [[nodiscard]] std::vector<VehicleId> withheld_by() const;

  /// Arc length of the end on the route, counted on from `s_m`, a place of the vehicle.
  [[nodiscard]] double end_s_m(double s_m) const;
  /// Whether arc length `at_s_m`, counted on from `s_m`, lies in a cell up to the end's: a plan
  /// that ends farther on would take a cell that was not granted.
  [[nodiscard]] bool reaches(double at_s_m, double s_m) const;
  /// An area across the lane behind the end, to be kept clear of.
  [[nodiscard]] ConvexPolygon bar_m(const RouteTracker& tracker, const Footprint& footprint) const;

 private:
  void decline(VehicleId own, const std::vector<right_of_way::Holder>& before,
               std::span<const right_of_way::Blocked> blocked);

  /// Another vehicle, as last received.
  struct Known {
    coordination::LaneClaim claim;
    StepIndex step;
  };

  std::shared_ptr<const right_of_way::ConflictMap> map_;
  const right_of_way::GrantOrder* order_;
  coordination::LaneClaim claim_;
  StepIndex now_;
  /// After `extend`: what all hold at the end of the step by `grant`; what limits this vehicle,
  /// itself included.
  std::vector<right_of_way::Holder> granted_;
  std::vector<right_of_way::Holder> holders_;
  std::vector<right_of_way::Blocked> blocked_;
  right_of_way::Taken taken_;  ///< in this step
  std::size_t own_place_{};
  bool is_limited_{};  ///< the end limits planning
  std::map<VehicleId, Known> known_;
  std::uint32_t unused_steps_{};  ///< for which it has stood with road in front of it
  bool has_place_{};
};

}  // namespace hlc::controller
