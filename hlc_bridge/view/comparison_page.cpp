#include "hlc_bridge/view/comparison_page.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <set>
#include <string_view>
#include <vector>

namespace hlc::view {
namespace {

using result::ComparedRun;
using result::ComparisonTable;
using result::RunComparison;

constexpr double kSpacing_m = 0.02;
constexpr std::size_t kColours = 8;

// Colours of the cars as in page/page.css: those of Okabe and Ito.
constexpr std::string_view kHead = R"(<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; style-src 'unsafe-inline'; img-src data:; base-uri 'none'; form-action 'none'">
<link rel="icon" href="data:,">
<title>Comparison of two runs</title>
<style>
:root {
  color-scheme: light dark;
  --page: #f6f6f4; --ground: #fff; --lane: #ececea; --bound: #bdbdb8; --text: #16181a;
  --muted: #62666a; --alarm: #b00020; --line: #d4d4d0;
  --car-0: #d55e00; --car-1: #0072b2; --car-2: #009e73; --car-3: #cc79a7; --car-4: #e69f00;
  --car-5: #56b4e9; --car-6: #b3a400; --car-7: #707070;
}
@media (prefers-color-scheme: dark) {
  :root {
    --page: #16181a; --ground: #101214; --lane: #24282b; --bound: #555b60; --text: #eceeef;
    --muted: #9aa0a6; --alarm: #ff8090; --line: #373b3f;
    --car-1: #1f7fc4; --car-2: #1fc093; --car-6: #f0e442; --car-7: #b0b0b0;
  }
}
body { margin: 1em auto; max-width: 70em; padding: 0 1em; background: var(--page); color: var(--text);
  font: 15px/1.4 system-ui, sans-serif; }
h1 { font-size: 20px; }
p { margin: .2em 0; overflow-wrap: anywhere; }
.result { font-weight: 600; margin: .6em 0; }
.scroll { overflow-x: auto; }
table { border-collapse: collapse; margin: 1em 0; }
th, td { padding: 2px 10px; border-top: 1px solid var(--line); text-align: right; white-space: nowrap; }
th:first-child, td:first-child { text-align: left; }
th { font-weight: 400; color: var(--muted); }
.map { display: block; width: 100%; max-height: 85vh; background: var(--ground); border: 1px solid var(--line); }
path, circle { fill: none; stroke-linejoin: round; vector-effect: non-scaling-stroke; }
.lane { fill: var(--lane); stroke: var(--bound); }
.other { stroke: var(--bound); stroke-dasharray: 2 3; }
.a { stroke-width: 6; opacity: .45; }
.b { stroke-width: 2; stroke-dasharray: 7 4; }
.car { stroke-width: 4; }
.mark { stroke: var(--alarm); stroke-width: 2.5; }
text { fill: var(--text); stroke: var(--ground); stroke-width: .25em; paint-order: stroke;
  text-anchor: middle; dominant-baseline: central; font-weight: 600; font-family: inherit; }
.legend { color: var(--muted); }
.legend span { margin-right: 1.2em; white-space: nowrap; }
.legend svg { width: 34px; height: 14px; vertical-align: middle; margin-right: 5px; }
</style>
</head>
<body>
)";

std::string html_text(std::string_view text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

std::string table_html(const ComparisonTable& table) {
  std::string html = "<div class=\"scroll\"><table>\n<tr>";
  for (const std::string& cell : table.heading) html += "<th>" + html_text(cell) + "</th>";
  html += "</tr>\n";
  for (const std::vector<std::string>& row : table.rows) {
    html += "<tr>";
    for (const std::string& cell : row) html += "<td>" + html_text(cell) + "</td>";
    html += "</tr>\n";
  }
  html += "</table></div>\n";
  for (const std::string& meaning : table.legend) {
    html += "<p class=\"legend\">" + html_text(meaning) + "</p>\n";
  }
  return html;
}

bool is_drawable(const Point& point_m) {
  return std::abs(point_m.x()) <= kLargestCoordinate_m &&
         std::abs(point_m.y()) <= kLargestCoordinate_m;
}

/// Positions since t(k0), `kSpacing_m` apart, and the last one.
std::vector<Point> path_of(const result::Drive& drive, const result::RunFacts& facts) {
  std::vector<Point> path_m;
  const Nanoseconds begin = facts.first_step.value_or(0) * facts.period;
  std::optional<Point> last_m;
  for (const result::DrivenSample& sample : drive) {
    const Point at_m = sample.pose.position_m();
    if (sample.t < begin || !is_drawable(at_m)) continue;
    last_m = at_m;
    if (path_m.empty() || (at_m - path_m.back()).norm() >= kSpacing_m) path_m.push_back(at_m);
  }
  if (last_m && path_m.back() != *last_m) path_m.push_back(*last_m);
  return path_m;
}

/// The picture in metres, y downwards.
class Picture {
 public:
  void add_path(const std::vector<Point>& points_m, const std::string& attributes, bool closed) {
    if (points_m.empty()) return;
    std::string places;
    for (const Point& point_m : points_m) {
      places +=
          fmt::format("{}{:.3f},{:.3f}", places.empty() ? "M" : " ", point_m.x(), -point_m.y());
      box_m_.extend(point_m);
    }
    // A path of one point has a stroke only if it has a segment.
    if (points_m.size() == 1) places += "h0";
    paths_ += fmt::format("<path {} d=\"{}{}\"/>\n", attributes, places, closed ? "z" : "");
  }
  void add_text(const Point& at_m, const std::string& text) { texts_.push_back({at_m, text}); }
  void add_ring(const Point& at_m) {
    box_m_.extend(at_m);
    rings_m_.push_back(at_m);
  }

  [[nodiscard]] std::string svg() const {
    if (box_m_.isEmpty()) return "<p>No lanes and no driven path are recorded.</p>\n";
    const double size_m = std::max(0.1, box_m_.sizes().maxCoeff());
    const double margin_m = 0.06 * size_m;
    std::string svg = fmt::format(
        "<svg class=\"map\" role=\"img\" aria-label=\"lanes and driven paths\" viewBox=\"{:.3f} "
        "{:.3f} {:.3f} {:.3f}\" font-size=\"{:.4f}\">\n{}",
        box_m_.min().x() - margin_m, -box_m_.max().y() - margin_m,
        box_m_.sizes().x() + 2.0 * margin_m, box_m_.sizes().y() + 2.0 * margin_m, 0.022 * size_m,
        paths_);
    for (const Point& at_m : rings_m_) {
      svg += fmt::format("<circle class=\"mark\" cx=\"{:.3f}\" cy=\"{:.3f}\" r=\"{:.4f}\"/>\n",
                         at_m.x(), -at_m.y(), 0.018 * size_m);
    }
    for (const auto& [at_m, text] : texts_) {
      svg += fmt::format("<text x=\"{:.3f}\" y=\"{:.3f}\">{}</text>\n", at_m.x(), -at_m.y(),
                         html_text(text));
    }
    return svg + "</svg>\n";
  }

 private:
  struct Text {
    Point at_m;
    std::string text;
  };
  std::string paths_;
  std::vector<Text> texts_;
  std::vector<Point> rings_m_;
  Eigen::AlignedBox2d box_m_;
};

void add_lanes(const std::optional<road::LaneletMap>& map, const char* name, Picture& picture) {
  if (!map) return;
  for (const auto& [id, lanelet] : map->lanelets) {
    std::vector<Point> outline_m = lanelet.left_m;
    outline_m.insert(outline_m.end(), lanelet.right_m.rbegin(), lanelet.right_m.rend());
    picture.add_path(outline_m, fmt::format("class=\"{}\"", name), true);
  }
}

std::set<std::uint8_t> vehicle_ids(const RunComparison& comparison) {
  std::set<std::uint8_t> ids;
  for (const ComparedRun* run : {&comparison.a, &comparison.b}) {
    ids.insert(run->facts.vehicle_ids.begin(), run->facts.vehicle_ids.end());
  }
  return ids;
}

std::string stroke(std::size_t vehicle) {
  return fmt::format("style=\"stroke:var(--car-{})\"", vehicle % kColours);
}

void add_drives(const RunComparison& comparison, const ComparedRun& run, const char* name,
                Picture& picture) {
  std::size_t number = 0;
  for (const std::uint8_t id : vehicle_ids(comparison)) {
    const std::string attributes = fmt::format("class=\"{}\" {}", name, stroke(number++));
    const auto drive = run.drives.find(id);
    if (drive == run.drives.end()) continue;
    const std::vector<Point> path_m = path_of(drive->second, run.facts);
    if (path_m.empty()) continue;
    picture.add_path(path_m, attributes, false);
    picture.add_text(path_m.front(), fmt::to_string(id));
  }
}

/// Where a car first drives elsewhere; if none does, the first difference of any kind.
const std::optional<result::Difference>& marked(const RunComparison& comparison) {
  return comparison.ways.first ? comparison.ways.first : comparison.first;
}

/// Where the vehicle is in that step; where it plans to be if its motion was not recorded.
std::optional<Point> place_of(const ComparedRun& run, const result::Difference& at) {
  const auto row = std::ranges::find_if(run.rows, [&](const result::StepRecord& candidate) {
    return candidate.step == at.step && candidate.record.report.vehicle == at.vehicle;
  });
  if (row == run.rows.end()) return std::nullopt;
  const Point at_m = row->driven.value_or(row->record.report.planned_pose).position_m();
  return is_drawable(at_m) ? std::optional(at_m) : std::nullopt;
}

std::string legend(const RunComparison& comparison) {
  const auto sample = [](const std::string& shape, const std::string& text) {
    return fmt::format("<span><svg viewBox=\"0 0 34 14\" aria-hidden=\"true\">{}</svg>{}</span>\n",
                       shape, text);
  };
  const std::string line = "<path class=\"{}\" d=\"M1,7H33\" {}/>";
  const std::string neutral = "style=\"stroke:currentColor\"";
  std::string html = "<p class=\"legend\">\n";
  html += sample(fmt::format(fmt::runtime(line), "a", neutral), "first run");
  html += sample(fmt::format(fmt::runtime(line), "b", neutral), "second run");
  if (const auto& mark = marked(comparison)) {
    html +=
        sample(R"(<circle class="mark" cx="17" cy="7" r="5"/>)",
               fmt::format("{}, vehicle {}, step {}",
                           comparison.ways.first ? "first to drive elsewhere" : "first difference",
                           mark->vehicle.value, mark->step));
  }
  std::size_t number = 0;
  for (const std::uint8_t id : vehicle_ids(comparison)) {
    html += sample(fmt::format(fmt::runtime(line), "car", stroke(number++)),
                   fmt::format("vehicle {}", id));
  }
  return html + "Numbers stand where the vehicles start.</p>\n";
}

std::string picture_html(const RunComparison& comparison,
                         const std::optional<road::LaneletMap>& map_a,
                         const std::optional<road::LaneletMap>& map_b) {
  Picture picture;
  add_lanes(map_a, "lane", picture);
  if (map_a != map_b) add_lanes(map_b, "other", picture);
  add_drives(comparison, comparison.a, "a", picture);
  add_drives(comparison, comparison.b, "b", picture);
  for (const ComparedRun* run : {&comparison.a, &comparison.b}) {
    if (!marked(comparison)) break;
    if (const auto at_m = place_of(*run, *marked(comparison))) picture.add_ring(*at_m);
  }
  return picture.svg() + legend(comparison);
}

}  // namespace

std::string comparison_page(const RunComparison& comparison,
                            const std::optional<road::LaneletMap>& map_a,
                            const std::optional<road::LaneletMap>& map_b) {
  std::string html{kHead};
  html += "<h1>Comparison of two runs</h1>\n";
  std::vector<std::string> lines = result::comparison_lines(comparison);
  const std::string result = std::move(lines.back());
  lines.pop_back();
  for (const std::string& line : lines) html += "<p>" + html_text(line) + "</p>\n";
  html += "<p class=\"result\">" + html_text(result) + "</p>\n";
  html += picture_html(comparison, map_a, map_b);
  html += table_html(result::vehicle_table(comparison));
  html += table_html(result::run_table(comparison));
  return html + "</body>\n</html>\n";
}

}  // namespace hlc::view
