#include "planner/road/commonroad_writer.hpp"

#include <fmt/format.h>

namespace hlc::road {

CommonRoadWriter::CommonRoadWriter(const CommonRoadHead& head) {
  PushDeclaration("xml version=\"1.0\" encoding=\"UTF-8\"");
  open("commonRoad");
  PushAttribute("commonRoadVersion", "2020a");
  PushAttribute("benchmarkID", head.benchmark_id.c_str());
  PushAttribute("date", "2025-01-01");
  PushAttribute("author", head.author.c_str());
  PushAttribute("affiliation", "none");
  PushAttribute("source", head.source.c_str());
  PushAttribute("timeStepSize", head.time_step.c_str());
  open("location");
  text("geoNameId", "-999", false);
  text("gpsLatitude", "999", false);
  text("gpsLongitude", "999", false);
  close();
  open("scenarioTags");
  for (const char* tag : {"urban", "intersection"}) {
    open_inline(tag);
    close_inline();
  }
  close_inline();
}

void CommonRoadWriter::add_lanelets(const LaneletMap& map) {
  for (const auto& [id, lanelet] : map.lanelets) {
    open("lanelet");
    PushAttribute("id", id);
    add_bound("leftBound", lanelet.left_m);
    add_bound("rightBound", lanelet.right_m);
    add_references("predecessor", lanelet.predecessors);
    add_references("successor", lanelet.successors);
    add_adjacent("adjacentLeft", lanelet.adjacent_left);
    add_adjacent("adjacentRight", lanelet.adjacent_right);
    text("laneletType", "urban", false);
    close();
  }
}

void CommonRoadWriter::text(const char* name, const std::string& text, bool is_inline) {
  OpenElement(name, is_inline);
  PushText(text.c_str());
  close_inline();
}

void CommonRoadWriter::number(const char* name, double value) {
  text(name, fmt::format("{:.9f}", value));
}

std::string CommonRoadWriter::finish() {
  close();
  return CStr();
}

void CommonRoadWriter::PrintSpace(int depth) {
  for (int i = 0; i < depth; ++i) Write("  ", 2);
}

void CommonRoadWriter::add_bound(const char* name, const std::vector<Point>& points_m) {
  open(name);
  for (const Point& point : points_m) {
    open("point");
    number("x", point.x());
    number("y", point.y());
    close_inline();
  }
  close();
}

void CommonRoadWriter::add_references(const char* name, const std::vector<LaneletId>& ids) {
  for (const LaneletId id : ids) {
    open(name);
    PushAttribute("ref", id);
    close();
  }
}

void CommonRoadWriter::add_adjacent(const char* name,
                                    const std::optional<Lanelet::Adjacent>& adjacent) {
  if (!adjacent) return;
  open(name);
  PushAttribute("ref", adjacent->id);
  PushAttribute("drivingDir", adjacent->same_direction ? "same" : "opposite");
  close();
}

}  // namespace hlc::road
