#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <vector>

#include "planner/automaton/automaton.hpp"
#include "planner/maneuver_design/automaton_configuration.hpp"
#include "planner/maneuver_design/solver/maneuver_solver.hpp"

namespace hlc::maneuver_design {

/// The optimal control problem between two trims of that vehicle, with its limits, including the
/// friction circle.
[[nodiscard]] ManeuverProblem problem_between(const automaton::Trim& from,
                                              const automaton::Trim& to,
                                              const AutomatonConfiguration& configuration);

/// One maneuver to be designed.
struct DesignTask {
  TrimPair edge;
  std::size_t criterion{};  ///< index into AutomatonConfiguration::criteria
};

/// All maneuvers that the configuration needs: for each criterion every pair of different trims
/// that a subgraph needs, or every pair that the limits permit (EdgeChoice), and the self-loops
/// that are designed (SelfLoops). By criterion as listed, from, to.
[[nodiscard]] std::vector<DesignTask> design_tasks(const AutomatonConfiguration& configuration);

/// Designs one maneuver. Independent of all others and without side effects: programs may call it
/// from several threads at once. Mirrored pairs of trims get mirrored maneuvers, bit by bit, unless
/// the pair is its own mirror image.
///
/// A normalised sum of criteria J_i with weights w_i becomes sum_i w_i J_i / (worst_i - best_i) on
/// each pair of trims: best_i is the optimum of J_i alone, worst_i the largest J_i among the optima
/// of the others (for two criteria these are the ends of the Pareto front). A criterion whose range
/// is less than 1e-6 of its size does not conflict there, and is left out; if none does, only the
/// first counts.
///
/// @throws std::invalid_argument with one line naming configuration, edge, label and reason if the
/// maneuver is infeasible or was not found (see ManeuverSolution::reason), or if its intervals are
/// so long that one Runge-Kutta step does not follow the model (see validate)
[[nodiscard]] automaton::Maneuver design(const AutomatonConfiguration& configuration,
                                         const DesignTask& task);

/// The same for many, one after the other, in their order. Of two mirrored ones only the first is
/// solved.
/// @param before_each  called before each; its exceptions end the design
[[nodiscard]] std::vector<automaton::Maneuver> design(
    const AutomatonConfiguration& configuration, const std::vector<DesignTask>& tasks,
    const std::function<void()>& before_each = {});

/// The automaton: every trim's self-loop (exact arc, label "trim"), then the designed maneuvers in
/// their order.
[[nodiscard]] automaton::UniversalAutomaton assembled(const AutomatonConfiguration& configuration,
                                                      std::vector<automaton::Maneuver> designed);

/// All three steps.
///
/// The same configuration gives the same automaton, bit for bit, on one machine.
[[nodiscard]] automaton::UniversalAutomaton build_automaton(
    const AutomatonConfiguration& configuration);

/// The same, ready for a Subgraph.
[[nodiscard]] std::shared_ptr<const automaton::UniversalAutomaton> build_shared_automaton(
    const AutomatonConfiguration& configuration);

}  // namespace hlc::maneuver_design
