#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "planner/coordination/report.hpp"

namespace hlc::apps {

/// What a vehicle did in a step.
struct StepOutcome {
  coordination::Report report;
  double ahead_m{};  ///< way that its plan in force leads from t(k+1) on, until it stands
};

/// A vehicle's step, and what it would have been without some others.
struct ExplainedStep {
  std::string name;      ///< of the vehicle
  std::uint64_t step{};  ///< from 0
  double step_s{};       ///< duration of a step
  StepOutcome outcome;
  std::vector<VehicleId> others;  ///< present in the step, sorted

  /// The same step of a run in which these vehicles are gone from this step on.
  struct Without {
    std::vector<VehicleId> gone;
    StepOutcome outcome;
  };
  std::vector<Without> without_one;    ///< for each vehicle that may matter
  std::optional<Without> without_all;  ///< for all of these together; none: there are none

  /// What the new plan begins with, and the runner-up (search::runner_up).
  struct Choice {
    std::string first;
    std::string next_best;  ///< empty: no plan begins with another maneuver
    double extra_m2{};      ///< by which the runner-up costs more
  };
  std::optional<Choice> choice;  ///< none without a plan of this step's search

  /// The step's problem searched again without one of its limits; all else, the others' plans
  /// included, as it was.
  struct Limit {
    std::string name;                  ///< "the lane boundary"; unused for a vehicle
    std::optional<VehicleId> vehicle;  ///< whose areas it is
    std::string note;                  ///< who sets it; may be empty
    std::optional<double> ahead_m;  ///< as in StepOutcome, of the plan found; none: there is none
    /// By which that plan costs more than the step's own in this problem: negative if the limit
    /// cost something. None: the step has no plan of its own.
    std::optional<double> extra_m2;
  };
  std::vector<Limit> limits;
  std::optional<Limit> alone;  ///< without any other vehicle; not needed with `without_all`
};

/// Lines of text: what the vehicle did and why, what it knew, what it would have done alone,
/// without each of the others, and without each limit of its problem.
[[nodiscard]] std::string explanation(const ExplainedStep& explained);

}  // namespace hlc::apps
