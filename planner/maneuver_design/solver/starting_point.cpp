#include "planner/maneuver_design/solver/starting_point.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace hlc::maneuver_design {
namespace {

/// Course of a channel's state from one end to the other.
enum class Course { kRamp, kHigh, kLow, kHighLow, kLowHigh };

/// Writes the scaled inputs that take the state from `from` to `to` by the highest states that the
/// bounds permit (as fast as possible up to the bound, as late as possible down from it), or, with
/// sign -1, by the lowest.
void write_extreme(double sign, double from, double to, const Channel& channel, double per_unit,
                   Eigen::Ref<Eigen::VectorXd> z) {
  const double bound = sign > 0.0 ? channel.state_max : -channel.state_min;
  double before = sign * from;
  for (Eigen::Index k = 0; k < z.size(); ++k) {
    const double reached = sign * from + per_unit * static_cast<double>(k + 1);
    const double left = sign * to + per_unit * static_cast<double>(z.size() - k - 1);
    const double after = k + 1 < z.size() ? std::min({reached, left, bound}) : sign * to;
    z(k) = std::clamp(sign * (after - before) / per_unit, -1.0, 1.0);
    // Full input exactly, so that rounding does not leave its bound inactive.
    constexpr double kRounding = 1e-12;
    if (std::abs(z(k)) > 1.0 - kRounding) {
      z(k) = z(k) > 0.0 ? 1.0 : -1.0;
    }
    before = after;
  }
}

Eigen::VectorXd along(Course course, const Channel& channel, const DecisionVariables& variables) {
  const Eigen::Index n = variables.intervals();
  Eigen::VectorXd z =
      Eigen::VectorXd::Constant(n, variables.wanted_mean(channel, variables.unit_s()));
  const double per_unit = variables.change_per_unit(channel);
  const Eigen::Index half = n / 2;
  const double middle =
      channel.from + channel.change() * static_cast<double>(half) / static_cast<double>(n);
  switch (course) {
    case Course::kRamp:
      break;
    case Course::kHigh:
    case Course::kLow:
      write_extreme(course == Course::kHigh ? 1.0 : -1.0, channel.from, channel.to, channel,
                    per_unit, z);
      break;
    case Course::kHighLow:
    case Course::kLowHigh: {
      const double first = course == Course::kHighLow ? 1.0 : -1.0;
      if (half > 0) {
        write_extreme(first, channel.from, middle, channel, per_unit, z.head(half));
      }
      write_extreme(-first, middle, channel.to, channel, per_unit, z.tail(n - half));
      break;
    }
  }
  return z;
}

/// +1 in the first intervals, -1 in the last, one value between them.
Eigen::VectorXd bang_bang(const Channel& channel, const DecisionVariables& variables) {
  Eigen::VectorXd z(variables.intervals());
  double rest = variables.wanted_mean(channel, variables.unit_s()) * static_cast<double>(z.size());
  for (Eigen::Index k = 0; k < z.size(); ++k) {
    z(k) = std::clamp(rest + static_cast<double>(z.size() - k - 1), -1.0, 1.0);
    rest -= z(k);
  }
  return z;
}

/// Every speed course with every steering course, cheapest first.
std::vector<Eigen::VectorXd> all_courses(const Transcription& transcription) {
  const DecisionVariables& variables = transcription.variables();
  const Channel speed = speed_channel(transcription.problem());
  const Channel steering = steering_channel(transcription.problem());
  std::vector<std::pair<double, Eigen::VectorXd>> courses;
  Eigen::VectorXd z = Eigen::VectorXd::Ones(variables.size());
  for (const Course speed_course : {Course::kRamp, Course::kHigh, Course::kLow}) {
    variables.of(speed, z) = along(speed_course, speed, variables);
    for (const Course steering_course :
         {Course::kRamp, Course::kHigh, Course::kLow, Course::kHighLow, Course::kLowHigh}) {
      variables.of(steering, z) = along(steering_course, steering, variables);
      courses.emplace_back(transcription.objective(z, nullptr), z);
    }
  }
  std::stable_sort(courses.begin(), courses.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<Eigen::VectorXd> result;
  for (auto& [cost, course] : courses) {
    result.push_back(std::move(course));
  }
  return result;
}

}  // namespace

double guessed_duration_s(const ManeuverProblem& problem, double shortest_duration_s) {
  if (!problem.free_duration) {
    return problem.duration_s;
  }
  return std::clamp(std::max(problem.duration_s, shortest_duration_s), problem.free_duration->min_s,
                    problem.free_duration->max_s);
}

std::vector<Eigen::VectorXd> starting_points(const Transcription& transcription,
                                             const SolverOptions& options) {
  const DecisionVariables& variables = transcription.variables();
  if (!options.start.empty()) {
    return {variables.variables(options.start, variables.unit_s())
                .cwiseMax(variables.lower())
                .cwiseMin(variables.upper())};
  }
  if (options.guess == Guess::kBest) {
    std::vector<Eigen::VectorXd> courses = all_courses(transcription);
    if (!transcription.running_cost().has_many_optima()) {
      courses.resize(1);
    }
    return courses;
  }
  Eigen::VectorXd z = Eigen::VectorXd::Ones(variables.size());
  for (const Channel& channel :
       {speed_channel(transcription.problem()), steering_channel(transcription.problem())}) {
    variables.of(channel, z) = options.guess == Guess::kBangBang
                                   ? bang_bang(channel, variables)
                                   : along(Course::kRamp, channel, variables);
  }
  return {z};
}

std::vector<vehicle::Input> resampled(const std::vector<vehicle::Input>& inputs,
                                      std::size_t intervals) {
  // Time in units of 1 / (old number * new number) of the duration: all bounds are whole numbers.
  const std::size_t old_length = intervals;
  const std::size_t new_length = inputs.size();
  std::vector<vehicle::Input> result(intervals);
  for (std::size_t k = 0; k < intervals; ++k) {
    const std::size_t begin = k * new_length;
    const std::size_t end = begin + new_length;
    for (std::size_t i = begin / old_length; i * old_length < end; ++i) {
      const std::size_t overlap =
          std::min(end, (i + 1) * old_length) - std::max(begin, i * old_length);
      const double share = static_cast<double>(overlap) / static_cast<double>(new_length);
      result[k].acceleration_mps2 += share * inputs[i].acceleration_mps2;
      result[k].steering_rate_radps += share * inputs[i].steering_rate_radps;
    }
  }
  return result;
}

}  // namespace hlc::maneuver_design
