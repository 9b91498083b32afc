#include "planner/maneuver_design/trim_choice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "planner/common/demand.hpp"
#include "planner/vehicle/lateral_acceleration.hpp"
#include "planner/vehicle/path_curvature.hpp"

namespace hlc::maneuver_design {
namespace {

constexpr int kMaxIterations = 1000;

std::size_t nearest(const Point& point, const std::vector<Point>& centres) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < centres.size(); ++i) {
    if ((point - centres[i]).squaredNorm() < (point - centres[best]).squaredNorm()) best = i;
  }
  return best;
}

/// The sample farthest from its nearest centre.
const Point& farthest(const std::vector<Point>& points, const std::vector<Point>& centres) {
  return *std::ranges::max_element(points, {}, [&centres](const Point& point) {
    return (point - centres[nearest(point, centres)]).squaredNorm();
  });
}

std::vector<Point> scattered(const std::vector<Point>& points, std::size_t count) {
  Point mean = Point::Zero();
  for (const Point& point : points) mean += point / static_cast<double>(points.size());
  std::vector<Point> centres{farthest(points, {mean})};
  while (centres.size() < count) {
    const Point& next = farthest(points, centres);
    if ((next - centres[nearest(next, centres)]).norm() == 0.0) {
      throw std::invalid_argument(fmt::format(
          "the drive has only {} different ways of moving, needed {}", centres.size(), count));
    }
    centres.push_back(next);
  }
  return centres;
}

/// Towards 0, so that a trim at a limit stays within it; with a tolerance for rounding.
double rounded(double value) {
  return std::trunc(value * 1000.0 + std::copysign(1e-6, value)) / 1000.0 + 0.0;
}

/// The motion between two points of a drive; nothing if it turns more than a quarter turn or on a
/// smaller circle than the vehicle can.
std::optional<DriveSample> sample_between(const DrivePoint& begin, const DrivePoint& end,
                                          const vehicle::VehicleParameters& vehicle) {
  const double turn_rad = wrap_angle(end.pose.heading_rad - begin.pose.heading_rad);
  const Point chord = end.pose.position_m() - begin.pose.position_m();
  const double chord_m = chord.norm();
  if (std::abs(turn_rad) > 0.5 * std::numbers::pi) return std::nullopt;
  const double half = 0.5 * std::abs(turn_rad);
  const double arc_m = half > 0.0 ? chord_m * half / std::sin(half) : chord_m;
  const double speed_mps = arc_m / (end.time_s - begin.time_s);
  if (speed_mps < kSlowestDrive_mps) return DriveSample{};
  if (std::abs(turn_rad / arc_m) * vehicle.rear_axle_to_cg_m >= 1.0) return std::nullopt;
  const double middle_rad = begin.pose.heading_rad + 0.5 * turn_rad;
  const double ahead_m = chord.dot(Point(std::cos(middle_rad), std::sin(middle_rad)));
  const double sign = ahead_m < 0.0 ? -1.0 : 1.0;
  return DriveSample{sign * speed_mps,
                     vehicle::steering_for_curvature_rad(sign * turn_rad / arc_m, vehicle)};
}

/// Speed and steering of the forward samples, within the limits and divided by `unit`.
std::vector<Point> forward_points(const std::vector<DriveSample>& drive, const Point& unit,
                                  const vehicle::VehicleLimits& limits) {
  std::vector<Point> points;
  for (const DriveSample& sample : drive) {
    if (sample.speed_mps < kSlowestDrive_mps) continue;
    points.emplace_back(
        std::clamp(sample.speed_mps, limits.speed_min_mps, limits.speed_max_mps) / unit.x(),
        std::clamp(sample.steering_rad, -limits.steering_max_rad, limits.steering_max_rad) /
            unit.y());
  }
  return points;
}

/// Moves each centre to the mean of the points nearest to it, until none moves.
/// @return number of points nearest to each centre
std::vector<std::size_t> converge_centres(const std::vector<Point>& points,
                                          std::vector<Point>& centres) {
  std::vector<std::size_t> sizes;
  for (int i = 0; i < kMaxIterations; ++i) {
    std::vector<Point> sums(centres.size(), Point::Zero());
    sizes.assign(centres.size(), 0);
    for (const Point& point : points) {
      const std::size_t cluster = nearest(point, centres);
      sums[cluster] += point;
      ++sizes[cluster];
    }
    const std::vector<Point> before = centres;
    for (std::size_t cluster = 0; cluster < centres.size(); ++cluster) {
      if (sizes[cluster] > 0)
        centres[cluster] = sums[cluster] / static_cast<double>(sizes[cluster]);
    }
    if (centres == before) break;
  }
  return sizes;
}

/// @param moving  neighbours in their order may be the same
void check_chosen(const std::vector<ChosenTrim>& moving, const vehicle::VehicleParameters& vehicle,
                  const vehicle::VehicleLimits& limits) {
  for (const ChosenTrim& one : moving) {
    if (!vehicle::is_within_friction({{}, one.trim.speed_mps, one.trim.steering_rad}, {}, vehicle,
                                     limits)) {
      throw std::invalid_argument(
          "the vehicle was driven beyond the friction circle of the limits");
    }
    if (!vehicle::is_within_curvature({{}, one.trim.speed_mps, one.trim.steering_rad}, {}, vehicle,
                                      limits)) {
      throw std::invalid_argument("the vehicle was driven beyond the curvature of the limits");
    }
  }
  const auto same = std::ranges::adjacent_find(moving, {}, &ChosenTrim::trim);
  if (same != moving.end()) {
    throw std::invalid_argument("two of the chosen trims are the same to 0.001; choose fewer");
  }
}

}  // namespace

bool is_reversing(const DriveSample& sample) { return sample.speed_mps <= -kSlowestDrive_mps; }

std::vector<DriveSample> drive_samples(const std::vector<DrivePoint>& points, double window_s,
                                       const vehicle::VehicleParameters& vehicle) {
  std::vector<DriveSample> samples;
  std::size_t end = 0;
  for (const DrivePoint& begin : points) {
    while (end < points.size() && points[end].time_s < begin.time_s + window_s) ++end;
    if (end == points.size()) break;
    if (const auto sample = sample_between(begin, points[end], vehicle)) samples.push_back(*sample);
  }
  return samples;
}

std::vector<ChosenTrim> choose_trims(const std::vector<DriveSample>& drive, std::size_t count,
                                     const vehicle::VehicleParameters& vehicle,
                                     const vehicle::VehicleLimits& limits) {
  HLC_DEMAND(count >= 2, count);
  const Point unit{limits.speed_max_mps, limits.steering_max_rad};
  const std::vector<Point> points = forward_points(drive, unit, limits);
  const auto reversing = static_cast<std::size_t>(std::ranges::count_if(drive, is_reversing));
  if (points.empty()) {
    throw std::invalid_argument(reversing > 0 ? "the vehicle never drove forwards"
                                              : "the vehicle stood for the whole drive");
  }

  std::vector<Point> centres = scattered(points, count - 1);
  const std::vector<std::size_t> sizes = converge_centres(points, centres);
  std::vector<ChosenTrim> moving;
  const std::size_t counted = drive.size() - reversing;
  const auto total = static_cast<double>(counted);
  for (std::size_t cluster = 0; cluster < centres.size(); ++cluster) {
    const Point& centre = centres[cluster];
    moving.push_back({{rounded(centre.x() * unit.x()), rounded(centre.y() * unit.y())},
                      static_cast<double>(sizes[cluster]) / total});
  }
  std::ranges::sort(moving, [](const ChosenTrim& a, const ChosenTrim& b) {
    return std::pair(a.trim.steering_rad, a.trim.speed_mps) <
           std::pair(b.trim.steering_rad, b.trim.speed_mps);
  });
  check_chosen(moving, vehicle, limits);
  std::vector<ChosenTrim> chosen{{{}, static_cast<double>(counted - points.size()) / total}};
  chosen.insert(chosen.end(), moving.begin(), moving.end());
  return chosen;
}

}  // namespace hlc::maneuver_design
