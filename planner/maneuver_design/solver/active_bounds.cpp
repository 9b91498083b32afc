#include "planner/maneuver_design/solver/active_bounds.hpp"

#include <algorithm>
#include <limits>

namespace hlc::maneuver_design {
namespace {

constexpr double kAt = 1e-9;  // a variable closer than this to a bound is at it

bool reaches_a_state_bound(const Transcription& transcription, const Channel& channel,
                           const Eigen::VectorXd& z) {
  return transcription.state_bounds(channel, z).value.maxCoeff() > -kAt * channel.scale();
}

/// Slope by which the end condition of a channel explains those of its variables: theirs between
/// the bounds, not below those at +1, not above those at -1.
double end_slope(const Eigen::VectorXd& values, const Eigen::VectorXd& slopes) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  double sum = 0.0;
  double count = 0.0;
  double least = -kInfinity;
  double greatest = kInfinity;
  for (Eigen::Index k = 0; k < values.size(); ++k) {
    if (values(k) > 1.0 - kAt) {
      least = std::max(least, slopes(k));
    } else if (values(k) < -1.0 + kAt) {
      greatest = std::min(greatest, slopes(k));
    } else {
      sum += slopes(k);
      count += 1.0;
    }
  }
  if (count > 0.0) {
    return sum / count;
  }
  if (least == -kInfinity || greatest == kInfinity) {
    return least == -kInfinity ? greatest : least;
  }
  return 0.5 * (least + greatest);
}

}  // namespace

std::vector<Eigen::Index> free_variables(const Transcription& transcription,
                                         const ConstraintSet& constraints, const Eigen::VectorXd& z,
                                         const Eigen::VectorXd& gradient) {
  const DecisionVariables& variables = transcription.variables();
  std::vector<Eigen::Index> free;
  for (const Channel& channel :
       {speed_channel(transcription.problem()), steering_channel(transcription.problem())}) {
    const Eigen::VectorXd values = variables.of(channel, z);
    const Eigen::VectorXd slopes = variables.of(channel, gradient);
    const bool has_state_bounds = channel.index == 0 ? constraints.speed : constraints.steering;
    const bool all_free = has_state_bounds && reaches_a_state_bound(transcription, channel, z);
    const double end = end_slope(values, slopes);
    const double clearly = 1e-3 * slopes.lpNorm<Eigen::Infinity>();
    for (Eigen::Index k = 0; k < values.size(); ++k) {
      const bool is_active = (values(k) > 1.0 - kAt && slopes(k) < end - clearly) ||
                             (values(k) < -1.0 + kAt && slopes(k) > end + clearly);
      if (all_free || !is_active) {
        free.push_back(2 * k + channel.index);
      }
    }
  }
  std::sort(free.begin(), free.end());
  if (variables.has_tau()) {
    free.push_back(variables.size() - 1);
  }
  return free;
}

}  // namespace hlc::maneuver_design
