#include "planner/maneuver_design/solver/attempt.hpp"

#include <algorithm>
#include <limits>

#include "planner/maneuver_design/feasibility.hpp"
#include "planner/maneuver_design/shooting.hpp"
#include "planner/maneuver_design/solver/active_bounds.hpp"
#include "planner/maneuver_design/solver/newton.hpp"
#include "planner/maneuver_design/solver/optimality.hpp"
#include "planner/maneuver_design/solver/slsqp.hpp"
#include "planner/maneuver_design/solver/starting_point.hpp"

namespace hlc::maneuver_design {
namespace {

constexpr double kGood = 1e-7;        // first-order residual of the objective: no more work
constexpr double kGoodEnough = 1e-5;  // no more rounds of SLSQP
constexpr std::size_t kCoarse = 20;   // intervals on which SLSQP searches the start for Newton

bool is_good(const Candidate& point) { return point.within_bounds && point.residual <= kGood; }

/// First criterion of the comparison: the constraints hold and nothing stopped the solver.
bool is_sound(const Candidate& point) { return point.within_bounds && point.reason.empty(); }

}  // namespace

Attempt::Attempt(const ManeuverProblem& problem, const RunningCost& cost,
                 const SolverOptions& options, double unit_s)
    : problem_(problem),
      cost_(cost),
      options_(options),
      transcription_(problem, cost, unit_s, options.tie_break) {
  constraints_.cost_bounds = !problem.cost_bounds.empty();
}

Candidate Attempt::solved() {
  std::vector<Eigen::VectorXd> starts = starting_points(transcription_, options_);
  if (starts_coarse()) {
    starts.resize(1);  // the coarse problem tries them all
  }
  Candidate best;
  double least = std::numeric_limits<double>::infinity();
  for (const Eigen::VectorXd& start : starts) {
    Candidate point = solved_from(start);
    const double cost = transcription_.cost(point.z, nullptr);
    const bool is_first = best.z.size() == 0;
    if (is_first || (is_sound(point) == is_sound(best) ? cost < least : is_sound(point))) {
      least = cost;
      best = std::move(point);
    }
  }
  return best;
}

Candidate Attempt::solved_from(const Eigen::VectorXd& start) {
  transcription_.scale_at(start);
  Candidate point = examined(start);
  if (!is_good(point)) {
    point = after_quick_way(point);
  }
  return is_good(point) ? point : after_long_way(start, point);
}

Candidate Attempt::after_quick_way(const Candidate& start) {
  Candidate point = start;
  if (starts_coarse()) {
    const Eigen::VectorXd z = from_coarse();
    transcription_.scale_at(z);
    point = examined(z);
  } else {
    point = after_few_rounds(start);
  }
  const bool may_go_on = evaluations() < options_.max_evaluations;
  return is_good(point) || !newton_applies() || !may_go_on ? point : refined(point);
}

Candidate Attempt::after_few_rounds(const Candidate& start) {
  constexpr int kFew = 12;
  for (;;) {
    const SlsqpResult result =
        run_slsqp(transcription_, constraints_, start.z, active_bounds_at(start.z),
                  {options_.cost_tolerance, std::min(kFew, options_.max_evaluations)});
    Candidate point = examined(result.z);
    if (!add_violated(point.z)) {
      return point;
    }
  }
}

Candidate Attempt::refined(const Candidate& point) {
  for (;;) {
    Candidate better = examined(newton(transcription_, constraints_, point.z).z);
    if (!add_violated(better.z)) {
      constexpr double kRounding = 1e-12;
      const bool is_better =
          better.within_bounds && better.objective <= point.objective + kRounding;
      return is_better ? better : point;
    }
    if (!newton_applies() || !point.within_bounds) {
      return point;
    }
  }
}

Eigen::VectorXd Attempt::from_coarse() {
  ManeuverProblem coarse = problem_;
  coarse.intervals = kCoarse;
  const DecisionVariables& variables = transcription_.variables();
  Attempt attempt(coarse, cost_, options_, variables.unit_s());
  attempt.constraints_ = constraints_;
  const Candidate point = attempt.solved();
  coarse_evaluations_ += attempt.evaluations();
  constraints_ = attempt.constraints_;
  const std::vector<vehicle::Input> inputs = attempt.transcription_.variables().inputs(point.z);
  return variables.variables(resampled(inputs, problem_.intervals), variables.unit_s());
}

// A restart drops a bad estimate of the curvature.
Candidate Attempt::after_long_way(const Eigen::VectorXd& start, const Candidate& quick) {
  constexpr int kRounds = 5;
  Candidate best = quick;
  for (int round = 0; round < kRounds; ++round) {
    const Eigen::VectorXd& from = best.within_bounds ? best.z : start;
    transcription_.scale_at(from);
    const SlsqpResult result =
        run_slsqp(transcription_, constraints_, from, Eigen::ArrayXi::Zero(from.size()),
                  {options_.cost_tolerance, options_.max_evaluations});
    Candidate point = examined(result.z);
    if (add_violated(point.z)) {
      continue;
    }
    best.objective = transcription_.objective(best.z, nullptr);
    const bool is_better =
        !best.within_bounds || (point.within_bounds && point.objective < best.objective);
    if (is_better) {
      best = std::move(point);
    }
    best.reason = result.reason;
    const bool is_done = best.within_bounds && (!is_better || best.residual <= kGoodEnough);
    if (!result.converged || is_done) {
      break;
    }
  }
  return best;
}

/// Makes z satisfy the end conditions to the last bits and evaluates it.
Candidate Attempt::examined(Eigen::VectorXd z) const {
  meet_end_condition(speed_channel(problem_), transcription_.variables(), z);
  meet_end_condition(steering_channel(problem_), transcription_.variables(), z);
  Candidate point;
  point.z = std::move(z);
  Eigen::VectorXd gradient;
  point.objective = transcription_.objective(point.z, &gradient);
  point.within_bounds = within_tolerance(residuals_at(point.z), problem_.limits);
  point.residual = first_order_residual_at(transcription_, point.z, gradient);
  return point;
}

ConstraintResiduals Attempt::residuals_at(const Eigen::VectorXd& z) const {
  const std::vector<vehicle::Input> inputs = transcription_.variables().inputs(z);
  const double duration_s = transcription_.variables().duration_s(z);
  const Shot shot =
      shoot(start_state(problem_), inputs, duration_s, cost_, problem_.vehicle, WithGradient::kNo);
  return residuals_of(problem_, inputs, shot.states, duration_s);
}

/// 1 for the variables whose bound is clearly active.
Eigen::ArrayXi Attempt::active_bounds_at(const Eigen::VectorXd& z) const {
  Eigen::ArrayXi active_bounds = Eigen::ArrayXi::Zero(z.size());
  if (newton_applies()) {
    Eigen::VectorXd gradient;
    (void)transcription_.objective(z, &gradient);
    active_bounds.setOnes();
    for (const Eigen::Index i : free_variables(transcription_, constraints_, z, gradient)) {
      active_bounds(i) = 0;
    }
  }
  return active_bounds;
}

/// Adds the kinds of inequality that z violates to those that a solver takes into account. True if
/// there is a new one.
bool Attempt::add_violated(const Eigen::VectorXd& z) {
  const ConstraintResiduals residuals = residuals_at(z);
  const ConstraintSet before = constraints_;
  const vehicle::VehicleLimits& limits = problem_.limits;
  constraints_.speed |= residuals.speed_mps > kFeasibilityTolerance * limits.speed_max_mps;
  constraints_.steering |= residuals.steering_rad > kFeasibilityTolerance * limits.steering_max_rad;
  constraints_.path |= residuals.path > kPathTolerance;
  return constraints_ != before;
}

bool Attempt::newton_applies() const {
  return !problem_.free_duration && !constraints_.path && !constraints_.cost_bounds;
}

bool Attempt::starts_coarse() const {
  return problem_.intervals > kCoarse && options_.start.empty() && !problem_.free_duration;
}

}  // namespace hlc::maneuver_design
