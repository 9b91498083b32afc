#pragma once

#include <memory>
#include <vector>

#include "planner/automaton/subgraph.hpp"
#include "planner/coordination/messages.hpp"

namespace hlc::coordination {

/// A plan of one vehicle: maneuvers (and self-loops of trims) one after the other, step by step
/// from t(first) on, then standing at the last pose forever. Because steps are numbered by time,
/// the same plan one step later is the same object: nothing is shifted; the past is just no longer
/// used.
///
/// Its maneuvers may be from several automata. Each automaton is kept as long as the plan has a
/// maneuver of it; without an owner the maneuvers must outlive the plan.
class Plan {
 public:
  using Owner = std::shared_ptr<const automaton::UniversalAutomaton>;

  /// Standing at `pose` from t(first) on.
  /// @param standstill  self-loop of an equilibrium trim
  /// @param owner       of it
  Plan(StepIndex first, const Pose& pose, const automaton::Maneuver& standstill,
       const Owner& owner = {});
  /// These maneuvers with these poses at t(first + i), then `standstill`.
  /// @param owner  of all
  /// @pre one pose more than maneuvers; they follow each other, and the self-loop follows them
  Plan(StepIndex first, std::vector<Pose> poses,
       const std::vector<const automaton::Maneuver*>& maneuvers,
       const automaton::Maneuver& standstill, const Owner& owner);

  /// This plan until t(step), then `continuation`, then `standstill`; what lies before t(step - 2)
  /// is forgotten.
  /// @param owner  of both
  /// @pre continuation starts with the trim of this plan at t(step) and ends in the trim whose
  /// self-loop is `standstill`
  [[nodiscard]] Plan continued(StepIndex step,
                               const std::vector<const automaton::Maneuver*>& continuation,
                               const automaton::Maneuver& standstill,
                               const Owner& owner = {}) const;
  /// The same where the new plan ends in the equilibrium trim in which this one does, and is of the
  /// same automaton.
  [[nodiscard]] Plan continued(StepIndex step,
                               const std::vector<const automaton::Maneuver*>& continuation) const {
    return continued(step, continuation, standstill_);
  }

  /// The same maneuvers from elsewhere: the whole plan moved rigidly so that `from` comes to `to`.
  [[nodiscard]] Plan moved(const Pose& from, const Pose& to) const;

  [[nodiscard]] StepIndex first() const { return first_; }
  /// First step index at whose time the plan stands for good.
  [[nodiscard]] StepIndex end() const;
  /// Planned pose at t(step); standing beyond the end. @pre step >= first()
  [[nodiscard]] const Pose& pose_at(StepIndex step) const;
  [[nodiscard]] TrimId trim_at(StepIndex step) const;
  /// The maneuver driven in [t(step), t(step + 1)].
  [[nodiscard]] const automaton::Maneuver& maneuver_during(StepIndex step) const;
  /// From t(step) on, until it stands; the first one at least. @pre step >= first()
  [[nodiscard]] std::vector<PlannedManeuver> maneuvers_from(StepIndex step) const;
  /// Planned state at t(step) + time_s, 0 <= time_s <= one step. @pre step >= first()
  [[nodiscard]] vehicle::State state_at(StepIndex step, double time_s,
                                        const vehicle::VehicleParameters& vehicle) const;
  /// Areas from t(from) on, and of standing at the end. The last of them holds the final one up to
  /// 2 um (swept areas are rounded outwards by 1 um, their corners mitred). @pre from >= first()
  [[nodiscard]] OccupiedAreas areas_from(StepIndex from) const;

 private:
  /// Shares its automaton, if that was given.
  using Entry = std::shared_ptr<const automaton::Maneuver>;

  Plan(StepIndex first, const Pose& pose, Entry standstill);
  [[nodiscard]] Plan continued(StepIndex step,
                               const std::vector<const automaton::Maneuver*>& continuation,
                               const Entry& standstill) const;
  [[nodiscard]] const Entry& entry_during(StepIndex step) const;

  StepIndex first_;
  Entry standstill_;
  std::vector<Entry> maneuvers_;
  std::vector<Pose> poses_;  ///< at t(first_ + i), one more than maneuvers
};

}  // namespace hlc::coordination
