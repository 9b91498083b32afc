#include "planner/road/driving_line.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

#include "planner/common/demand.hpp"
#include "planner/geometry/near_points.hpp"
#include "planner/geometry/pose.hpp"

namespace hlc::road {
namespace {

// Lengths for the µCar; for others scale_of times as long, but for kHalfChord_m of a line alone.
constexpr double kSampling_m = 0.04;
constexpr double kHalfChord_m = 0.05;
constexpr double kCurvatureChord_m = 0.10;
/// Share of the room towards the kerb by which the line is moved.
constexpr double kShare = 0.372;
/// Samples to either side over which the offset is averaged.
constexpr std::ptrdiff_t kSmoothed = 4;
/// A neighbour lane: the other path's distance across, in lane widths, its distance along and the
/// angle between the two.
constexpr double kNearestLane = 0.67;
constexpr double kFarthestLane = 1.27;
constexpr double kBeside_m = 0.06;
constexpr double kParallel_rad = 0.4;

/// Equidistant poses along a closed path.
std::vector<Pose> samples_of(const ReferencePath& path, double scale) {
  const double sampling_m = scale * kSampling_m;
  const auto count = static_cast<std::size_t>(std::max(1.0, path.length_m() / sampling_m));
  std::vector<Pose> samples;
  for (std::size_t i = 0; i < count; ++i) {
    const double s_m = path.length_m() * static_cast<double>(i) / static_cast<double>(count);
    const Point point_m = path.at(s_m);
    samples.push_back(
        {point_m.x(), point_m.y(), chord_heading_rad(path, s_m, scale * kHalfChord_m)});
  }
  return samples;
}

struct Sides {
  bool left{};
  bool right{};
};

class NeighbourLanes {
 public:
  NeighbourLanes(const std::vector<std::vector<Pose>>& paths, double lane_width_m, double beside_m)
      : lane_width_m_(lane_width_m),
        beside_m_(beside_m),
        near_(std::hypot(kFarthestLane * lane_width_m, beside_m)) {
    for (const std::vector<Pose>& path : paths) {
      for (const Pose& pose : path) {
        poses_.push_back(pose);
        near_.add(pose.position_m());
      }
    }
  }

  [[nodiscard]] Sides beside(const Pose& pose) const {
    const Point along{std::cos(pose.heading_rad), std::sin(pose.heading_rad)};
    Sides sides;
    near_.visit(pose.position_m(), [&](std::size_t i) { note(pose, along, poses_[i], sides); });
    return sides;
  }

 private:
  void note(const Pose& pose, const Point& along, const Pose& other, Sides& sides) const {
    const Point apart_m = other.position_m() - pose.position_m();
    const double across_m = along.x() * apart_m.y() - along.y() * apart_m.x();
    bool& side = across_m > 0.0 ? sides.left : sides.right;
    if (side || std::abs(along.dot(apart_m)) > beside_m_) return;
    const double lanes = std::abs(across_m) / lane_width_m_;
    if (lanes < kNearestLane || lanes > kFarthestLane) return;
    side = std::abs(std::remainder(other.heading_rad - pose.heading_rad, std::numbers::pi)) <=
           kParallel_rad;
  }

  double lane_width_m_;
  double beside_m_;
  std::vector<Pose> poses_;
  NearPoints near_;
};

std::vector<double> smoothed(const std::vector<double>& values) {
  const auto count = static_cast<std::ptrdiff_t>(values.size());
  std::vector<double> result;
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    double sum = 0.0;
    for (std::ptrdiff_t d = -kSmoothed; d <= kSmoothed; ++d) {
      sum += values[static_cast<std::size_t>(((i + d) % count + count) % count)];
    }
    result.push_back(sum / static_cast<double>(2 * kSmoothed + 1));
  }
  return result;
}

}  // namespace

DrivingLine::DrivingLine(std::vector<double> left_m, double length_m)
    : left_m_(std::move(left_m)), length_m_(length_m) {
  HLC_DEMAND(!left_m_.empty() && length_m > 0.0, left_m_.size(), length_m);
}

double DrivingLine::left_m(double s_m) const {
  if (left_m_.empty()) return 0.0;
  const auto count = static_cast<double>(left_m_.size());
  const double at = (s_m / length_m_ - std::floor(s_m / length_m_)) * count;
  const auto before = static_cast<std::size_t>(at) % left_m_.size();
  const double share = at - std::floor(at);
  return (1.0 - share) * left_m_[before] + share * left_m_[(before + 1) % left_m_.size()];
}

Point DrivingLine::at(const ReferencePath& path, double s_m) const {
  const double left = left_m(s_m);
  if (left == 0.0) return path.at(s_m);
  const double heading_rad = chord_heading_rad(path, s_m, kHalfChord_m);
  return path.at(s_m) + left * Point(-std::sin(heading_rad), std::cos(heading_rad));
}

std::vector<DrivingLine> driving_lines(std::span<const ReferencePath> paths, double lane_width_m,
                                       const Footprint& footprint) {
  std::vector<std::vector<Pose>> samples;
  const double scale = scale_of(footprint);
  for (const ReferencePath& path : paths) samples.push_back(samples_of(path, scale));
  const NeighbourLanes lanes(samples, lane_width_m, scale * kBeside_m);
  const double room_m = (lane_width_m - footprint.width_m) / 2.0;
  const double overhang_m2 = footprint.length_m * footprint.length_m / 8.0;
  std::vector<DrivingLine> lines;
  for (std::size_t p = 0; p < paths.size(); ++p) {
    std::vector<double> left_m;
    for (std::size_t i = 0; i < samples[p].size(); ++i) {
      const double s_m =
          paths[p].length_m() * static_cast<double>(i) / static_cast<double>(samples[p].size());
      const double overhang_m =
          overhang_m2 * chord_curvature_per_m(paths[p], s_m, scale * kCurvatureChord_m);
      const Sides sides = lanes.beside(samples[p][i]);
      const double away = sides.left == sides.right ? 0.0 : sides.right ? 1.0 : -1.0;
      left_m.push_back(away * kShare * (room_m + away * overhang_m));
    }
    lines.emplace_back(smoothed(left_m), paths[p].length_m());
  }
  return lines;
}

}  // namespace hlc::road
