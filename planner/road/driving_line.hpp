#pragma once

#include <span>
#include <vector>

#include "planner/geometry/footprint.hpp"
#include "planner/road/reference_path.hpp"

namespace hlc::road {

/// A line along a closed path, beside it: what a vehicle follows where others share the road.
class DrivingLine {
 public:
  DrivingLine() = default;  ///< the path itself
  /// @param left_m  offset to the left of the path at equal distances along it; not empty
  DrivingLine(std::vector<double> left_m, double length_m);

  /// Offset to the left of the path at arc length s, interpolated. [m]
  [[nodiscard]] double left_m(double s_m) const;
  /// The point of the line beside the path's point at arc length s.
  [[nodiscard]] Point at(const ReferencePath& path, double s_m) const;

 private:
  std::vector<double> left_m_;
  double length_m_{};
};

/// Lines that leave room between two cars side by side. Lanes of the lab are 0.150 m wide, a car
/// 0.107 m: 0.043 m between two footprints, of which 0.020 m are the safety margins (0.040 m of
/// the lab's vehicles), and in a
/// curvature kappa the corners of a car of length l reach l^2 / 8 * kappa farther out. Towards a
/// kerb, where no margin is needed, there is room to spare. So where a lane has a neighbour lane on
/// one side only, the line is moved away from it, by
///
///     0.372 (w - b) / 2 -+ 0.372 l^2 / 8 * kappa
///
/// with the lane's width w, the car's width b, kappa > 0 to the left; - if the kerb is on the
/// right. 0.372 makes 8 mm on the lab's straight lanes. Of six runs of twenty cars with a
/// contouring weight of 60, five came to a standstill without lines, two with 7 mm, one each with 8
/// and 9 mm. Neighbour lanes, of either direction, are recognised by other paths at about a lane's
/// width. Averaged over 0.36 m.
/// @param paths  closed; all routes of a run
[[nodiscard]] std::vector<DrivingLine> driving_lines(std::span<const ReferencePath> paths,
                                                     double lane_width_m,
                                                     const Footprint& footprint);

}  // namespace hlc::road
