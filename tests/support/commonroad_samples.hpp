#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "planner/geometry/footprint.hpp"
#include "planner/road/commonroad_writer.hpp"
#include "planner/road/lanelet_map.hpp"

/// CommonRoad files with planning problems for full-size cars, made by code.
namespace hlc::test {

/// The middle of a lane: places with its direction there.
using Line = std::vector<Pose>;

/// A straight line with a point every few metres.
[[nodiscard]] Line straight(const Point& from_m, const Point& to_m);
/// An arc that begins in the pose and turns to the left by the angle, to the right if negative.
[[nodiscard]] Line arc(const Pose& from, double radius_m, double turned_rad);

/// What the goal state of a problem may hold, as XML.
[[nodiscard]] std::string rectangle_at(const Pose& middle, const Footprint& size);
[[nodiscard]] std::string circle_at(const Point& middle_m, double radius_m);
[[nodiscard]] std::string polygon_at(const std::vector<Point>& corners_m);
[[nodiscard]] std::string lanelet_ref(road::LaneletId id);

/// A CommonRoad 2020a file under construction.
class CommonRoadSketch {
 public:
  static constexpr double kLaneWidth_m = 3.6;
  static constexpr char kBenchmarkId[] = "ZAM_Sketch-1_1_T-1";

  /// A lanelet along the line.
  CommonRoadSketch& lane(road::LaneletId id, const Line& middle, double width_m = kLaneWidth_m);
  /// The second one succeeds the first one.
  CommonRoadSketch& joined(road::LaneletId from, road::LaneletId to);
  /// One lies to the left of the other.
  CommonRoadSketch& beside(road::LaneletId left, road::LaneletId right, bool same_direction = true);
  /// A static obstacle with one shape around its position.
  CommonRoadSketch& obstacle(int id, const Pose& at, const std::string& shape);
  CommonRoadSketch& parked_car(int id, const Pose& at) {
    return obstacle(id, at, "<rectangle><length>4.5</length><width>1.8</width></rectangle>");
  }
  /// A problem with one goal state per text, a position as XML.
  CommonRoadSketch& problem(int id, const Pose& start, const std::vector<std::string>& goals,
                            double speed_mps = 0.0);
  /// More in the goal states of later problems, as XML.
  CommonRoadSketch& in_goals(const std::string& more) {
    in_goals_ = more;
    return *this;
  }
  /// Any element of the file.
  CommonRoadSketch& element(const std::string& xml) {
    elements_ += xml;
    return *this;
  }

  /// The file, with times in steps of 0.1 s.
  [[nodiscard]] std::string xml() const;

 private:
  road::LaneletMap map_{.benchmark_id = kBenchmarkId, .lanelets = {}};
  std::string elements_;
  std::string problems_;
  std::string in_goals_;
};

/// A file of one kind of problem.
struct CommonRoadSample {
  std::string name;
  std::string xml;
  std::size_t problems{};
};

/// One of each kind, all of which a car of passenger_cars_in_town can solve: to a goal of each
/// shape, bends, parked cars within the lanes, changes of the lane, merging, crossing, oncoming
/// cars, an obstacle field, a roundabout, several problems.
[[nodiscard]] std::vector<CommonRoadSample> commonroad_samples();

}  // namespace hlc::test
