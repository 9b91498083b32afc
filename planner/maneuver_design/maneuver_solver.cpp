#include "planner/maneuver_design/maneuver_solver.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <nlopt.hpp>
#include <sstream>

#include "planner/maneuver_design/criteria.hpp"
#include "planner/maneuver_design/first_order.hpp"
#include "planner/maneuver_design/sensitivities.hpp"
#include "planner/maneuver_design/shooting.hpp"
#include "planner/maneuver_design/travel_time.hpp"

namespace hlc {
namespace {

constexpr double kFeasibilityTolerance = 1e-9;  // relative to each bound
constexpr double kFirstOrderTolerance = 1e-3;   // relative to the slope of the cost
constexpr double kPathTolerance = 1e-8;         // of g

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

/// Decision variables z: the inputs of all intervals, each divided by its bound; then, if the
/// duration is free, tau = T / (duration of the guess).
class Scaling {
 public:
  Scaling(const ManeuverProblem& problem, double duration_s)
      : intervals_(problem.intervals),
        is_free_(problem.free_duration.has_value()),
        duration_s_(duration_s),
        acceleration_mps2_(problem.limits.acceleration_mps2),
        steering_rate_radps_(problem.limits.steering_rate_radps) {}

  [[nodiscard]] std::size_t size() const { return 2 * intervals_ + (is_free_ ? 1 : 0); }
  [[nodiscard]] std::vector<Input> inputs(const double* z) const {
    std::vector<Input> inputs(intervals_);
    for (std::size_t k = 0; k < intervals_; ++k) {
      inputs[k] = {z[2 * k] * acceleration_mps2_, z[2 * k + 1] * steering_rate_radps_};
    }
    return inputs;
  }
  [[nodiscard]] std::vector<double> variables(const ManeuverSolution& solution) const {
    std::vector<double> z(size(), solution.duration_s / duration_s_);
    for (std::size_t k = 0; k < intervals_; ++k) {
      z[2 * k] = solution.inputs[k].acceleration_mps2 / acceleration_mps2_;
      z[2 * k + 1] = solution.inputs[k].steering_rate_radps / steering_rate_radps_;
    }
    return z;
  }
  [[nodiscard]] Eigen::Vector2d gradient(const Eigen::Vector2d& input_gradient) const {
    return {input_gradient.x() * acceleration_mps2_, input_gradient.y() * steering_rate_radps_};
  }
  [[nodiscard]] bool is_free() const { return is_free_; }
  [[nodiscard]] double tau(const double* z) const { return is_free_ ? z[2 * intervals_] : 1.0; }
  /// Duration of the guess, tau = 1.
  [[nodiscard]] double unit_s() const { return duration_s_; }
  [[nodiscard]] double duration_s(const double* z) const { return tau(z) * duration_s_; }

 private:
  std::size_t intervals_;
  bool is_free_;
  double duration_s_;
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
  const Shot shot = shoot(start_state(problem), context.scaling.inputs(z),
                          context.scaling.duration_s(z), context.cost, problem.vehicle,
                          gradient == nullptr ? WithGradient::kNo : WithGradient::kYes);
  for (std::size_t k = 0; k < shot.gradient.size(); ++k) {
    Eigen::Map<Eigen::Vector2d>(gradient + 2 * k) =
        context.scaling.gradient(shot.gradient[k]) / context.unit;
  }
  if (gradient != nullptr && context.scaling.is_free()) {
    gradient[2 * problem.intervals] =
        shot.duration_gradient * context.scaling.unit_s() / context.unit;
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
  const Scaling& scaling;
  std::size_t intervals;
};

/// tau mean(z) - wanted = 0.
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
      gradient[2 * k + context.channel.index] = context.scaling.tau(z) * share;
    }
    if (context.scaling.is_free()) {
      gradient[n - 1] = mean;
    }
  }
  return context.scaling.tau(z) * mean - context.wanted;
}

struct PathContext {
  Channel channel;
  double change_per_unit;  ///< of the state, by one interval of z = 1, with tau = 1
  const Scaling& scaling;
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
  const double change_per_unit = context.scaling.tau(z) * context.change_per_unit;
  double state = context.channel.from;
  for (std::size_t k = 0; k < inner; ++k) {
    state += change_per_unit * z[2 * k + context.channel.index];
    result[2 * k] = state - context.channel.state_max;
    result[2 * k + 1] = context.channel.state_min - state;
    for (std::size_t i = 0; gradient != nullptr && i <= k; ++i) {
      const std::size_t column = 2 * i + context.channel.index;
      gradient[2 * k * n + column] = change_per_unit;
      gradient[(2 * k + 1) * n + column] = -change_per_unit;
    }
    if (gradient != nullptr && context.scaling.is_free()) {
      const double by_tau = (state - context.channel.from) / context.scaling.tau(z);
      gradient[2 * k * n + n - 1] = by_tau;
      gradient[(2 * k + 1) * n + n - 1] = -by_tau;
    }
  }
}

/// All g_i at both ends of all intervals.
void path_constraints(unsigned /*m*/, double* result, unsigned n, const double* z, double* gradient,
                      void* data) {
  const CostContext& context = *static_cast<const CostContext*>(data);
  const ManeuverProblem& problem = context.problem;
  const std::vector<Input> inputs = context.scaling.inputs(z);
  const double duration_s = context.scaling.duration_s(z);
  const std::vector<State> states = shoot(start_state(problem), inputs, duration_s, context.cost,
                                          problem.vehicle, WithGradient::kNo)
                                        .states;
  std::vector<Eigen::Matrix<double, 5, Eigen::Dynamic>> slopes;
  if (gradient != nullptr) {
    slopes = sensitivities(states, inputs, duration_s, problem.vehicle);
  }
  const Eigen::Vector2d unit = context.scaling.gradient(Eigen::Vector2d::Ones());
  Eigen::Index row = 0;
  for (const auto& constraint : problem.path_constraints) {
    for (std::size_t k = 0; k < inputs.size(); ++k) {
      for (const std::size_t end : {k, k + 1}) {
        const StateVector x = to_vector(states[end]);
        result[row] = constraint->value(x, inputs[k]);
        if (gradient != nullptr) {
          const CostGradient g = constraint->gradient(x, inputs[k]);
          Eigen::RowVectorXd slope = g.state.transpose() * slopes[end];
          slope.segment<2>(2 * static_cast<Eigen::Index>(k)) += g.input.transpose();
          Eigen::Map<Eigen::RowVectorXd> out(gradient + row * static_cast<Eigen::Index>(n), n);
          for (Eigen::Index i = 0; i < static_cast<Eigen::Index>(2 * inputs.size()); ++i) {
            out(i) = slope(i) * unit(i % 2);
          }
          if (context.scaling.is_free()) {
            out(n - 1) = slope(slope.size() - 1) * context.scaling.unit_s();
          }
        }
        ++row;
      }
    }
  }
}

/// Duration at which the search starts.
double guessed_duration_s(const ManeuverProblem& problem, double shortest_s) {
  if (!problem.free_duration) {
    return problem.duration_s;
  }
  return std::clamp(std::max(problem.duration_s, shortest_s), problem.free_duration->min_s,
                    problem.free_duration->max_s);
}

std::vector<double> initial_guess(const ManeuverProblem& problem, const Scaling& scaling,
                                  Guess guess) {
  std::vector<double> z(scaling.size(), 1.0);
  for (const Channel& channel : {speed_channel(problem), steering_channel(problem)}) {
    const double mean = wanted_mean(channel, scaling.unit_s());
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

/// Which constraints along the maneuver the solver is told of.
struct PathBounds {
  bool speed{};
  bool steering{};
  bool constraints{};
};

NumericResult run_slsqp(CostContext& context, const SolverOptions& options, PathBounds bounds,
                        const std::vector<double>& start) {
  const ManeuverProblem& problem = context.problem;
  const Channel speed = speed_channel(problem);
  const Channel steering = steering_channel(problem);
  const std::size_t intervals = problem.intervals;
  const Scaling& scaling = context.scaling;
  const double interval_s = scaling.unit_s() / static_cast<double>(intervals);

  nlopt::opt slsqp(nlopt::LD_SLSQP, static_cast<unsigned>(scaling.size()));
  std::vector<double> lower(scaling.size(), -1.0);
  std::vector<double> upper(scaling.size(), 1.0);
  if (problem.free_duration) {
    lower.back() = problem.free_duration->min_s / scaling.unit_s();
    upper.back() = problem.free_duration->max_s / scaling.unit_s();
  }
  slsqp.set_lower_bounds(lower);
  slsqp.set_upper_bounds(upper);
  slsqp.set_min_objective(scaled_cost, &context);
  constexpr double kEndTolerance = 1e-13;
  EndContext speed_end{speed, wanted_mean(speed, scaling.unit_s()), scaling, intervals};
  EndContext steering_end{steering, wanted_mean(steering, scaling.unit_s()), scaling, intervals};
  slsqp.add_equality_constraint(end_condition, &speed_end, kEndTolerance);
  slsqp.add_equality_constraint(end_condition, &steering_end, kEndTolerance);
  PathContext speed_path{speed, interval_s * speed.input_max, scaling, intervals};
  PathContext steering_path{steering, interval_s * steering.input_max, scaling, intervals};
  const std::vector<double> path_tolerances(2 * (intervals - 1), 1e-10);
  if (bounds.speed) {
    slsqp.add_inequality_mconstraint(path_bounds, &speed_path, path_tolerances);
  }
  if (bounds.steering) {
    slsqp.add_inequality_mconstraint(path_bounds, &steering_path, path_tolerances);
  }
  if (bounds.constraints) {
    slsqp.add_inequality_mconstraint(
        path_constraints, &context,
        std::vector<double>(2 * intervals * problem.path_constraints.size(), 1e-10));
  }
  slsqp.set_ftol_rel(options.cost_tolerance);
  slsqp.set_maxeval(options.max_evaluations);

  NumericResult result;
  result.z = start;
  for (std::size_t i = 0; i < start.size(); ++i) {
    result.z[i] = std::clamp(start[i], lower[i], upper[i]);
  }
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
void meet_end_condition(const Channel& channel, const Scaling& scaling, std::vector<double>& z) {
  const std::size_t intervals = z.size() / 2;
  double mean = 0.0;
  for (std::size_t k = 0; k < intervals; ++k) {
    mean += z[2 * k + channel.index] / static_cast<double>(intervals);
  }
  const double shift = wanted_mean(channel, scaling.duration_s(z.data())) - mean;
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
  for (const auto& constraint : problem.path_constraints) {
    for (std::size_t k = 0; k < inputs.size(); ++k) {
      r.path = std::max({r.path, constraint->value(to_vector(states[k]), inputs[k]),
                         constraint->value(to_vector(states[k + 1]), inputs[k])});
    }
  }
  return r;
}

bool within_tolerance(const ConstraintResiduals& r, const VehicleLimits& limits) {
  const double t = kFeasibilityTolerance;
  return r.end_speed_mps <= t * limits.speed_max_mps &&
         r.end_steering_rad <= t * limits.steering_max_rad &&
         r.acceleration_mps2 <= t * limits.acceleration_mps2 &&
         r.steering_rate_radps <= t * limits.steering_rate_radps &&
         r.speed_mps <= t * limits.speed_max_mps && r.steering_rad <= t * limits.steering_max_rad &&
         r.path <= kPathTolerance;
}

/// Fills `reason` and `shortest_duration_s`; true if an input within the bounds connects the trims.
bool is_feasible(const ManeuverProblem& problem, ManeuverSolution& solution) {
  solution.shortest_duration_s = 0.0;
  const double longest_s =
      problem.free_duration ? problem.free_duration->max_s : problem.duration_s;
  std::ostringstream reason;
  for (const Trim& trim : {problem.from, problem.to}) {
    const State state{Pose{}, trim.speed_mps, trim.steering_rad};
    for (const auto& constraint : problem.path_constraints) {
      if (constraint->value(to_vector(state), Input{}) > kPathTolerance) {
        reason << "trim of speed " << trim.speed_mps << " m/s and steering " << trim.steering_rad
               << " rad violates the " << constraint->name() << "; ";
        solution.shortest_duration_s = std::numeric_limits<double>::infinity();
      }
    }
  }
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
    if (shortest_s > longest_s * (1.0 + kFeasibilityTolerance)) {
      reason << state_name << " " << channel.from << " -> " << channel.to << state_unit << " in "
             << longest_s << " s needs " << input_name << " "
             << std::abs(channel.change()) / longest_s << input_unit << ", allowed "
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
  solution.duration_s = context.scaling.duration_s(z.data());
  Shot shot = shoot(start_state(problem), solution.inputs, solution.duration_s, context.cost,
                    problem.vehicle, WithGradient::kNo);
  solution.states = std::move(shot.states);
  solution.cost = shot.cost;
  solution.residuals = residuals_of(problem, solution.inputs, solution.states);
}

/// Residual of the first-order conditions at a solution, in variables scaled as the solver's.
double residual_at(const ManeuverProblem& problem, const RunningCost& cost,
                   const ManeuverSolution& solution) {
  constexpr double kActive = 1e-6;
  CostContext context{problem, cost, Scaling(problem, solution.duration_s)};
  const Scaling& scaling = context.scaling;
  const std::vector<double> z = scaling.variables(solution);
  const auto n = static_cast<Eigen::Index>(scaling.size());
  const auto size = static_cast<unsigned>(n);
  Eigen::VectorXd gradient(n);
  (void)scaled_cost(size, z.data(), gradient.data(), &context);

  Eigen::MatrixXd equalities(n, 2);
  std::vector<Eigen::VectorXd> active;
  const auto add_active = [&](const std::vector<double>& values,
                              const std::vector<double>& gradients, double within) {
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (values[i] > -within) {
        active.emplace_back(Eigen::Map<const Eigen::VectorXd>(gradients.data() + i * size, n));
      }
    }
  };
  for (const Channel& channel : {speed_channel(problem), steering_channel(problem)}) {
    EndContext end{channel, wanted_mean(channel, scaling.unit_s()), scaling, problem.intervals};
    (void)end_condition(size, z.data(),
                        equalities.col(static_cast<Eigen::Index>(channel.index)).data(), &end);
    PathContext path{channel,
                     scaling.unit_s() / static_cast<double>(problem.intervals) * channel.input_max,
                     scaling, problem.intervals};
    std::vector<double> values(2 * (problem.intervals - 1));
    std::vector<double> gradients(values.size() * size);
    path_bounds(0, values.data(), size, z.data(), gradients.data(), &path);
    add_active(values, gradients, kActive * channel.state_max);
  }
  std::vector<double> values(2 * problem.intervals * problem.path_constraints.size());
  std::vector<double> gradients(values.size() * size);
  path_constraints(0, values.data(), size, z.data(), gradients.data(), &context);
  add_active(values, gradients, kActive);
  for (Eigen::Index i = 0; i < n; ++i) {
    const bool is_tau = scaling.is_free() && i == n - 1;
    const double lower = is_tau ? problem.free_duration->min_s / scaling.unit_s() : -1.0;
    const double upper = is_tau ? problem.free_duration->max_s / scaling.unit_s() : 1.0;
    const double value = z[static_cast<std::size_t>(i)];
    if (value > upper - kActive) {
      active.emplace_back(Eigen::VectorXd::Unit(n, i));
    }
    if (value < lower + kActive) {
      active.emplace_back(-Eigen::VectorXd::Unit(n, i));
    }
  }
  Eigen::MatrixXd columns(n, static_cast<Eigen::Index>(active.size()));
  for (std::size_t i = 0; i < active.size(); ++i) {
    columns.col(static_cast<Eigen::Index>(i)) = active[i];
  }
  return first_order_residual(gradient, equalities, columns);
}

/// Told what it violates, the solver avoids it. True if there is something new to tell.
bool add_violated(const ConstraintResiduals& residuals, const VehicleLimits& limits,
                  PathBounds& bounds) {
  const PathBounds before = bounds;
  bounds.speed |= residuals.speed_mps > kFeasibilityTolerance * limits.speed_max_mps;
  bounds.steering |= residuals.steering_rad > kFeasibilityTolerance * limits.steering_max_rad;
  bounds.constraints |= residuals.path > kPathTolerance;
  return bounds.speed != before.speed || bounds.steering != before.steering ||
         bounds.constraints != before.constraints;
}

void value_all_criteria(const ManeuverProblem& problem, ManeuverSolution& solution) {
  for (const std::string& name : criterion_names()) {
    const auto criterion = make_criterion(name, problem.vehicle);
    solution.criteria.push_back(
        {name, shoot(start_state(problem), solution.inputs, solution.duration_s, *criterion,
                     problem.vehicle, WithGradient::kNo)
                   .cost});
  }
}

/// Turns the solver's variables into a solution that meets the end conditions.
void finish(CostContext& context, NumericResult& numeric, ManeuverSolution& solution) {
  meet_end_condition(speed_channel(context.problem), context.scaling, numeric.z);
  meet_end_condition(steering_channel(context.problem), context.scaling, numeric.z);
  simulate(context, numeric.z, solution);
}

/// Starts the solver again where it stopped, as long as the first-order conditions do not hold and
/// the cost falls: a fresh start forgets a bad estimate of the curvature.
void polish(CostContext& context, const SolverOptions& options, PathBounds bounds,
            NumericResult& numeric, ManeuverSolution& solution) {
  constexpr int kRounds = 4;
  constexpr double kGoodEnough = 1e-5;
  const ManeuverProblem& problem = context.problem;
  for (int round = 0; round < kRounds; ++round) {
    if (residual_at(problem, context.cost, solution) <= kGoodEnough) {
      return;
    }
    context.unit = solution.cost != 0.0 ? std::abs(solution.cost) : 1.0;
    NumericResult again = run_slsqp(context, options, bounds, numeric.z);
    ManeuverSolution candidate = solution;
    finish(context, again, candidate);
    if (add_violated(candidate.residuals, problem.limits, bounds)) {
      continue;
    }
    const bool was_feasible = within_tolerance(solution.residuals, problem.limits);
    const bool is_better = !was_feasible || candidate.cost < solution.cost;
    if (!again.converged || !is_better || !within_tolerance(candidate.residuals, problem.limits)) {
      return;
    }
    numeric = std::move(again);
    solution = std::move(candidate);
  }
}

/// Solves the problem; does not ask why g_i cannot be satisfied.
ManeuverSolution attempt(const ManeuverProblem& problem, const RunningCost& cost,
                         const SolverOptions& options) {
  assert(problem.intervals >= 1 && problem.duration_s > 0.0);
  ManeuverSolution solution;
  if (!is_feasible(problem, solution)) {
    solution.status = ManeuverStatus::kInfeasible;
    return solution;
  }
  CostContext context{problem, cost,
                      Scaling(problem, guessed_duration_s(problem, solution.shortest_duration_s))};
  const std::vector<double> guess = initial_guess(problem, context.scaling, options.guess);
  const double at_guess = std::abs(scaled_cost(0, guess.data(), nullptr, &context));
  context.unit = at_guess > 0.0 ? at_guess : 1.0;

  PathBounds bounds;
  NumericResult numeric;
  do {
    numeric = run_slsqp(context, options, bounds, guess);
    finish(context, numeric, solution);
  } while (add_violated(solution.residuals, problem.limits, bounds));
  if (numeric.converged) {
    polish(context, options, bounds, numeric, solution);
  }
  solution.evaluations = context.evaluations;
  solution.first_order_residual = residual_at(problem, cost, solution);
  solution.reason = numeric.reason;
  if (numeric.converged && !within_tolerance(solution.residuals, problem.limits)) {
    solution.reason = "the solver's result violates a constraint";
  } else if (numeric.converged && solution.first_order_residual > kFirstOrderTolerance) {
    std::ostringstream reason;
    reason << "the solver stopped where the first-order residual is "
           << solution.first_order_residual << ", allowed " << kFirstOrderTolerance;
    solution.reason = reason.str();
  }
  value_all_criteria(problem, solution);
  solution.status =
      solution.reason.empty() ? ManeuverStatus::kOptimal : ManeuverStatus::kNotConverged;
  return solution;
}

/// Asks, for a problem whose g_i the solver could not satisfy, how long they need. Makes the
/// solution an infeasible one if that is longer than allowed.
void explain_path_violation(const ManeuverProblem& problem, const SolverOptions& options,
                            ManeuverSolution& solution) {
  const double longest_s =
      problem.free_duration ? problem.free_duration->max_s : problem.duration_s;
  ManeuverProblem fastest = problem;
  constexpr double kAmple = 10.0;
  fastest.duration_s = kAmple * longest_s;
  fastest.free_duration = DurationRange{longest_s, 2.0 * kAmple * longest_s};
  SolverOptions from_constant = options;
  from_constant.guess = Guess::kConstant;
  ManeuverSolution found = attempt(fastest, TravelTime{}, from_constant);
  if (found.status != ManeuverStatus::kOptimal ||
      found.duration_s <= longest_s * (1.0 + kPathTolerance)) {
    return;
  }
  std::ostringstream reason;
  for (const auto& constraint : problem.path_constraints) {
    reason << constraint->name() << " does not allow the change in " << longest_s << " s; ";
  }
  reason << "shortest feasible duration " << found.duration_s << " s";
  const int evaluations = solution.evaluations + found.evaluations;
  solution = {};
  solution.status = ManeuverStatus::kInfeasible;
  solution.reason = reason.str();
  solution.shortest_duration_s = found.duration_s;
  solution.evaluations = evaluations;
}

}  // namespace

ManeuverSolution solve(const ManeuverProblem& problem, const RunningCost& cost,
                       const SolverOptions& options) {
  ManeuverSolution solution = attempt(problem, cost, options);
  if (solution.residuals.path > kPathTolerance) {
    explain_path_violation(problem, options, solution);
  }
  return solution;
}

}  // namespace hlc
