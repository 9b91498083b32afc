#include "planner/maneuver_design/maneuver_solver.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <nlopt.hpp>
#include <sstream>

#include "planner/maneuver_design/shooting.hpp"

namespace hlc {
namespace {

constexpr double kFeasibilityTolerance = 1e-9;  // relative to each bound

/// One of the two inputs, with the state that it drives: u_v and v, or u_delta and delta.
struct Channel {
  std::size_t index;  ///< of the input in u
  double from;
  double to;
  double input_max;
  double state_min;
  double state_max;

  [[nodiscard]] double change() const { return to - from; }
};

Channel speed_channel(const ManeuverProblem& p) {
  return {0,
          p.from.speed_mps,
          p.to.speed_mps,
          p.limits.acceleration_mps2,
          p.limits.speed_min_mps,
          p.limits.speed_max_mps};
}

Channel steering_channel(const ManeuverProblem& p) {
  return {1,
          p.from.steering_rad,
          p.to.steering_rad,
          p.limits.steering_rate_radps,
          -p.limits.steering_max_rad,
          p.limits.steering_max_rad};
}

/// Decision variables z: the inputs of all intervals, each divided by its bound.
class Scaling {
 public:
  explicit Scaling(const ManeuverProblem& problem)
      : intervals_(problem.intervals),
        acceleration_mps2_(problem.limits.acceleration_mps2),
        steering_rate_radps_(problem.limits.steering_rate_radps) {}

  [[nodiscard]] std::vector<Input> inputs(const double* z) const {
    std::vector<Input> inputs(intervals_);
    for (std::size_t k = 0; k < intervals_; ++k) {
      inputs[k] = {z[2 * k] * acceleration_mps2_, z[2 * k + 1] * steering_rate_radps_};
    }
    return inputs;
  }
  [[nodiscard]] Eigen::Vector2d gradient(const Eigen::Vector2d& input_gradient) const {
    return {input_gradient.x() * acceleration_mps2_, input_gradient.y() * steering_rate_radps_};
  }

 private:
  std::size_t intervals_;
  double acceleration_mps2_;
  double steering_rate_radps_;
};

struct CostContext {
  const ManeuverProblem& problem;
  const RunningCost& cost;
  Scaling scaling;
  double unit{1.0};  ///< the cost is divided by this
  int evaluations{};
};

State start_state(const ManeuverProblem& problem) {
  return {Pose{}, problem.from.speed_mps, problem.from.steering_rad};
}

double scaled_cost(unsigned /*n*/, const double* z, double* gradient, void* data) {
  CostContext& context = *static_cast<CostContext*>(data);
  ++context.evaluations;
  const ManeuverProblem& problem = context.problem;
  const Shot shot =
      shoot(start_state(problem), context.scaling.inputs(z), problem.duration_s, context.cost,
            problem.vehicle, gradient == nullptr ? WithGradient::kNo : WithGradient::kYes);
  for (std::size_t k = 0; k < shot.gradient.size(); ++k) {
    Eigen::Map<Eigen::Vector2d>(gradient + 2 * k) =
        context.scaling.gradient(shot.gradient[k]) / context.unit;
  }
  return shot.cost / context.unit;
}

/// Mean of a channel's scaled inputs that the end condition asks for; |mean| <= 1 is feasible.
double wanted_mean(const Channel& channel, double duration_s) {
  return channel.change() / (duration_s * channel.input_max);
}

struct EndContext {
  Channel channel;
  double wanted;
  std::size_t intervals;
};

/// mean(z) - wanted = 0.
double end_condition(unsigned n, const double* z, double* gradient, void* data) {
  const EndContext& context = *static_cast<const EndContext*>(data);
  const double share = 1.0 / static_cast<double>(context.intervals);
  double mean = 0.0;
  for (std::size_t k = 0; k < context.intervals; ++k) {
    mean += share * z[2 * k + context.channel.index];
  }
  if (gradient != nullptr) {
    std::fill(gradient, gradient + n, 0.0);
    for (std::size_t k = 0; k < context.intervals; ++k) {
      gradient[2 * k + context.channel.index] = share;
    }
  }
  return mean - context.wanted;
}

struct PathContext {
  Channel channel;
  double change_per_unit;  ///< of the state, by one interval of z = 1
  std::size_t intervals;
};

/// state_k - state_max <= 0 and state_min - state_k <= 0 at the inner interval bounds k = 1 ... N
/// - 1.
void path_bounds(unsigned /*m*/, double* result, unsigned n, const double* z, double* gradient,
                 void* data) {
  const PathContext& context = *static_cast<const PathContext*>(data);
  const std::size_t inner = context.intervals - 1;
  if (gradient != nullptr) {
    std::fill(gradient, gradient + 2 * inner * n, 0.0);
  }
  double state = context.channel.from;
  for (std::size_t k = 0; k < inner; ++k) {
    state += context.change_per_unit * z[2 * k + context.channel.index];
    result[2 * k] = state - context.channel.state_max;
    result[2 * k + 1] = context.channel.state_min - state;
    for (std::size_t i = 0; gradient != nullptr && i <= k; ++i) {
      const std::size_t column = 2 * i + context.channel.index;
      gradient[2 * k * n + column] = context.change_per_unit;
      gradient[(2 * k + 1) * n + column] = -context.change_per_unit;
    }
  }
}

std::vector<double> initial_guess(const ManeuverProblem& problem, Guess guess) {
  std::vector<double> z(2 * problem.intervals);
  for (const Channel& channel : {speed_channel(problem), steering_channel(problem)}) {
    const double mean = wanted_mean(channel, problem.duration_s);
    // Bang-bang: +1 in the first intervals, -1 in the last, one value between them.
    double rest = mean * static_cast<double>(problem.intervals);
    for (std::size_t k = 0; k < problem.intervals; ++k) {
      const double after = static_cast<double>(problem.intervals - k - 1);
      const double value = guess == Guess::kConstant ? mean : std::clamp(rest + after, -1.0, 1.0);
      z[2 * k + channel.index] = value;
      rest -= value;
    }
  }
  return z;
}

struct NumericResult {
  std::vector<double> z;
  bool converged{};
  std::string reason;
};

struct PathBounds {
  bool speed{};
  bool steering{};
};

NumericResult run_slsqp(CostContext& context, const SolverOptions& options, PathBounds bounds) {
  const ManeuverProblem& problem = context.problem;
  const Channel speed = speed_channel(problem);
  const Channel steering = steering_channel(problem);
  const std::size_t intervals = problem.intervals;
  const double interval_s = problem.duration_s / static_cast<double>(intervals);

  nlopt::opt slsqp(nlopt::LD_SLSQP, static_cast<unsigned>(2 * intervals));
  slsqp.set_lower_bounds(-1.0);
  slsqp.set_upper_bounds(1.0);
  slsqp.set_min_objective(scaled_cost, &context);
  constexpr double kEndTolerance = 1e-13;
  EndContext speed_end{speed, wanted_mean(speed, problem.duration_s), intervals};
  EndContext steering_end{steering, wanted_mean(steering, problem.duration_s), intervals};
  slsqp.add_equality_constraint(end_condition, &speed_end, kEndTolerance);
  slsqp.add_equality_constraint(end_condition, &steering_end, kEndTolerance);
  PathContext speed_path{speed, interval_s * speed.input_max, intervals};
  PathContext steering_path{steering, interval_s * steering.input_max, intervals};
  const std::vector<double> path_tolerances(2 * (intervals - 1), 1e-10);
  if (bounds.speed) {
    slsqp.add_inequality_mconstraint(path_bounds, &speed_path, path_tolerances);
  }
  if (bounds.steering) {
    slsqp.add_inequality_mconstraint(path_bounds, &steering_path, path_tolerances);
  }
  slsqp.set_ftol_rel(options.cost_tolerance);
  slsqp.set_maxeval(options.max_evaluations);

  NumericResult result;
  result.z = initial_guess(problem, options.guess);
  double scaled = 0.0;
  try {
    const nlopt::result code = slsqp.optimize(result.z, scaled);
    result.converged = code != nlopt::MAXEVAL_REACHED;
    if (!result.converged) {
      result.reason =
          "not converged after " + std::to_string(options.max_evaluations) + " evaluations";
    }
  } catch (const nlopt::roundoff_limited&) {
    // No further progress is possible in floating point: as good as converged. The residuals
    // decide.
    result.converged = true;
  } catch (const std::runtime_error& error) {
    result.reason = std::string("NLopt: ") + error.what();
  }
  return result;
}

/// Shifts a channel's inputs evenly so that the end condition holds to the last bits.
void meet_end_condition(const Channel& channel, double duration_s, std::vector<double>& z) {
  const std::size_t intervals = z.size() / 2;
  double mean = 0.0;
  for (std::size_t k = 0; k < intervals; ++k) {
    mean += z[2 * k + channel.index] / static_cast<double>(intervals);
  }
  const double shift = wanted_mean(channel, duration_s) - mean;
  for (std::size_t k = 0; k < intervals; ++k) {
    double& value = z[2 * k + channel.index];
    value = std::clamp(value + shift, -1.0, 1.0);
  }
}

ConstraintResiduals residuals_of(const ManeuverProblem& problem, const std::vector<Input>& inputs,
                                 const std::vector<State>& states) {
  const VehicleLimits& limits = problem.limits;
  ConstraintResiduals r;
  r.end_speed_mps = std::abs(states.back().speed_mps - problem.to.speed_mps);
  r.end_steering_rad = std::abs(states.back().steering_rad - problem.to.steering_rad);
  for (const Input& u : inputs) {
    r.acceleration_mps2 =
        std::max(r.acceleration_mps2, std::abs(u.acceleration_mps2) - limits.acceleration_mps2);
    r.steering_rate_radps = std::max(r.steering_rate_radps,
                                     std::abs(u.steering_rate_radps) - limits.steering_rate_radps);
  }
  for (const State& x : states) {
    r.speed_mps = std::max(
        {r.speed_mps, x.speed_mps - limits.speed_max_mps, limits.speed_min_mps - x.speed_mps});
    r.steering_rad = std::max(r.steering_rad, std::abs(x.steering_rad) - limits.steering_max_rad);
  }
  return r;
}

bool within_tolerance(const ConstraintResiduals& r, const VehicleLimits& limits) {
  const double t = kFeasibilityTolerance;
  return r.end_speed_mps <= t * limits.speed_max_mps &&
         r.end_steering_rad <= t * limits.steering_max_rad &&
         r.acceleration_mps2 <= t * limits.acceleration_mps2 &&
         r.steering_rate_radps <= t * limits.steering_rate_radps &&
         r.speed_mps <= t * limits.speed_max_mps && r.steering_rad <= t * limits.steering_max_rad;
}

/// Fills `reason` and `shortest_duration_s`; true if an input within the bounds connects the trims.
bool is_feasible(const ManeuverProblem& problem, ManeuverSolution& solution) {
  solution.shortest_duration_s = 0.0;
  std::ostringstream reason;
  for (const Channel& channel : {speed_channel(problem), steering_channel(problem)}) {
    const bool is_speed = channel.index == 0;
    const char* const state_name = is_speed ? "speed" : "steering";
    const char* const state_unit = is_speed ? " m/s" : " rad";
    const char* const input_name = is_speed ? "acceleration" : "steering rate";
    const char* const input_unit = is_speed ? " m/s^2" : " rad/s";
    for (const double value : {channel.from, channel.to}) {
      if (value < channel.state_min || value > channel.state_max) {
        reason << state_name << " of a trim = " << value << state_unit << ", allowed "
               << channel.state_min << " ... " << channel.state_max << state_unit << "; ";
        solution.shortest_duration_s = std::numeric_limits<double>::infinity();
      }
    }
    const double shortest_s = std::abs(channel.change()) / channel.input_max;
    solution.shortest_duration_s = std::max(solution.shortest_duration_s, shortest_s);
    if (shortest_s > problem.duration_s * (1.0 + kFeasibilityTolerance)) {
      reason << state_name << " " << channel.from << " -> " << channel.to << state_unit << " in "
             << problem.duration_s << " s needs " << input_name << " "
             << std::abs(channel.change()) / problem.duration_s << input_unit << ", allowed "
             << channel.input_max << input_unit << "; ";
    }
  }
  solution.reason = reason.str();
  if (solution.reason.empty()) {
    return true;
  }
  std::ostringstream shortest;
  shortest << solution.reason << "shortest feasible duration " << solution.shortest_duration_s
           << " s";
  solution.reason = shortest.str();
  return false;
}

void simulate(CostContext& context, const std::vector<double>& z, ManeuverSolution& solution) {
  const ManeuverProblem& problem = context.problem;
  solution.inputs = context.scaling.inputs(z.data());
  Shot shot = shoot(start_state(problem), solution.inputs, problem.duration_s, context.cost,
                    problem.vehicle, WithGradient::kNo);
  solution.states = std::move(shot.states);
  solution.cost = shot.cost;
  solution.residuals = residuals_of(problem, solution.inputs, solution.states);
}

}  // namespace

ManeuverSolution solve(const ManeuverProblem& problem, const RunningCost& cost,
                       const SolverOptions& options) {
  assert(problem.intervals >= 1 && problem.duration_s > 0.0);
  ManeuverSolution solution;
  if (!is_feasible(problem, solution)) {
    solution.status = ManeuverStatus::kInfeasible;
    return solution;
  }
  CostContext context{problem, cost, Scaling(problem)};
  const std::vector<double> guess = initial_guess(problem, options.guess);
  const double at_guess = std::abs(scaled_cost(0, guess.data(), nullptr, &context));
  context.unit = at_guess > 0.0 ? at_guess : 1.0;

  PathBounds bounds;
  NumericResult numeric;
  for (bool again = true; again;) {
    numeric = run_slsqp(context, options, bounds);
    meet_end_condition(speed_channel(problem), problem.duration_s, numeric.z);
    meet_end_condition(steering_channel(problem), problem.duration_s, numeric.z);
    simulate(context, numeric.z, solution);
    const VehicleLimits& limits = problem.limits;
    const bool add_speed = !bounds.speed && solution.residuals.speed_mps >
                                                kFeasibilityTolerance * limits.speed_max_mps;
    const bool add_steering =
        !bounds.steering &&
        solution.residuals.steering_rad > kFeasibilityTolerance * limits.steering_max_rad;
    bounds.speed = bounds.speed || add_speed;
    bounds.steering = bounds.steering || add_steering;
    again = add_speed || add_steering;
  }
  solution.evaluations = context.evaluations;
  solution.reason = numeric.reason;
  if (numeric.converged && !within_tolerance(solution.residuals, problem.limits)) {
    solution.reason = "the solver's result violates a constraint";
  }
  solution.status =
      solution.reason.empty() ? ManeuverStatus::kOptimal : ManeuverStatus::kNotConverged;
  return solution;
}

}  // namespace hlc
