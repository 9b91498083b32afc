#include <fmt/format.h>

#include <cmath>

#include "tests/support/commonroad_samples.hpp"

namespace hlc::test {
namespace {

constexpr double kSpacing_m = 2.0;

std::string point_text(const char* name, const Point& point_m) {
  return fmt::format("<{0}><x>{1:.9f}</x><y>{2:.9f}</y></{0}>", name, point_m.x(), point_m.y());
}

/// Left of the line by that much.
std::vector<Point> shifted(const Line& line, double left_m) {
  std::vector<Point> points_m;
  for (const Pose& at : line) points_m.push_back(transformed(Point(0.0, left_m), at));
  return points_m;
}

}  // namespace

Line straight(const Point& from_m, const Point& to_m) {
  const auto pieces =
      static_cast<std::size_t>(std::ceil((to_m - from_m).norm() / (2.0 * kSpacing_m)));
  const Point along_m = (to_m - from_m) / static_cast<double>(pieces);
  Line line;
  for (std::size_t i = 0; i <= pieces; ++i) {
    const Point at_m = from_m + static_cast<double>(i) * along_m;
    line.push_back({at_m.x(), at_m.y(), std::atan2(along_m.y(), along_m.x())});
  }
  return line;
}

Line arc(const Pose& from, double radius_m, double turned_rad) {
  const double side = turned_rad > 0.0 ? 1.0 : -1.0;
  const auto pieces =
      static_cast<std::size_t>(std::ceil(radius_m * std::abs(turned_rad) / kSpacing_m));
  Line line;
  for (std::size_t i = 0; i <= pieces; ++i) {
    const double angle_rad =
        std::abs(turned_rad) * static_cast<double>(i) / static_cast<double>(pieces);
    line.push_back(
        compose(from, {radius_m * std::sin(angle_rad),
                       side * radius_m * (1.0 - std::cos(angle_rad)), side * angle_rad}));
  }
  return line;
}

std::string rectangle_at(const Pose& middle, const Footprint& size) {
  return fmt::format(
      "<rectangle><length>{}</length><width>{}</width><orientation>{}</orientation>{}</rectangle>",
      size.length_m, size.width_m, middle.heading_rad, point_text("center", middle.position_m()));
}

std::string circle_at(const Point& middle_m, double radius_m) {
  return fmt::format("<circle><radius>{}</radius>{}</circle>", radius_m,
                     point_text("center", middle_m));
}

std::string polygon_at(const std::vector<Point>& corners_m) {
  std::string corners;
  for (const Point& corner : corners_m) corners += point_text("point", corner);
  return "<polygon>" + corners + "</polygon>";
}

std::string lanelet_ref(road::LaneletId id) { return fmt::format("<lanelet ref=\"{}\"/>", id); }

CommonRoadSketch& CommonRoadSketch::lane(road::LaneletId id, const Line& middle, double width_m) {
  map_.lanelets[id] = {.id = id,
                       .left_m = shifted(middle, width_m / 2.0),
                       .right_m = shifted(middle, -width_m / 2.0),
                       .predecessors = {},
                       .successors = {},
                       .adjacent_left = {},
                       .adjacent_right = {}};
  return *this;
}

CommonRoadSketch& CommonRoadSketch::joined(road::LaneletId from, road::LaneletId to) {
  map_.lanelets.at(from).successors.push_back(to);
  map_.lanelets.at(to).predecessors.push_back(from);
  return *this;
}

CommonRoadSketch& CommonRoadSketch::beside(road::LaneletId left, road::LaneletId right,
                                           bool same_direction) {
  map_.lanelets.at(right).adjacent_left = {.id = left, .same_direction = same_direction};
  const road::Lanelet::Adjacent other{.id = right, .same_direction = same_direction};
  (same_direction ? map_.lanelets.at(left).adjacent_right : map_.lanelets.at(left).adjacent_left) =
      other;
  return *this;
}

CommonRoadSketch& CommonRoadSketch::obstacle(int id, const Pose& at, const std::string& shape) {
  return element(fmt::format(
      "<staticObstacle id=\"{}\"><type>parkedVehicle</type><shape>{}</shape><initialState>"
      "<position>{}</position><orientation><exact>{}</exact></orientation><time><exact>0</exact>"
      "</time></initialState></staticObstacle>\n",
      id, shape, point_text("point", at.position_m()), at.heading_rad));
}

CommonRoadSketch& CommonRoadSketch::problem(int id, const Pose& start,
                                            const std::vector<std::string>& goals,
                                            double speed_mps) {
  problems_ += fmt::format(
      "<planningProblem id=\"{}\"><initialState><position>{}</position><orientation><exact>{}"
      "</exact></orientation><time><exact>0</exact></time><velocity><exact>{}</exact></velocity>"
      "<yawRate><exact>0</exact></yawRate><slipAngle><exact>0</exact></slipAngle></initialState>",
      id, point_text("point", start.position_m()), start.heading_rad, speed_mps);
  for (const std::string& goal : goals) {
    problems_ += fmt::format(
        "<goalState><position>{}</position>{}<time><intervalStart>0</intervalStart>"
        "<intervalEnd>600</intervalEnd></time></goalState>",
        goal, in_goals_);
  }
  problems_ += "</planningProblem>\n";
  return *this;
}

std::string CommonRoadSketch::xml() const {
  road::CommonRoadWriter writer({.benchmark_id = map_.benchmark_id,
                                 .author = "commonroad_samples",
                                 .source = "generated",
                                 .time_step = "0.1"});
  writer.add_lanelets(map_);
  std::string text = writer.finish();
  text.insert(text.rfind("</commonRoad>"), elements_ + problems_);
  return text;
}

}  // namespace hlc::test
