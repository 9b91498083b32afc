#pragma once

#include <vector>

#include "planner/maneuver_design/solver/maneuver_solver.hpp"
#include "planner/maneuver_design/solver/transcription.hpp"

namespace hlc::maneuver_design {

/// Duration at which the search starts: the given one, or, if it is free, the nearest duration
/// within the bounds that is long enough.
[[nodiscard]] double guessed_duration_s(const ManeuverProblem& problem, double shortest_duration_s);

/// Starting points of the search: `options.start`, or the guess; for a cost with many local optima
/// every course of Guess::kBest, cheapest first. All guesses meet the end conditions; all except
/// kBangBang keep the bounds on states.
[[nodiscard]] std::vector<Eigen::VectorXd> starting_points(const Transcription& transcription,
                                                           const SolverOptions& options);

/// The same inputs over time on another number of intervals: each new one is the mean over its
/// time. Keeps the ends and the bounds on states.
[[nodiscard]] std::vector<vehicle::Input> resampled(const std::vector<vehicle::Input>& inputs,
                                                    std::size_t intervals);

}  // namespace hlc::maneuver_design
