#include "planner/plot/search_pictures.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>
#include <vector>

#include "planner/geometry/footprint.hpp"
#include "planner/plot/svg_elements.hpp"
#include "planner/plot/ticks.hpp"

namespace hlc::plot {
namespace {

using Eigen::Vector2d;
using search::Fate;
using search::RecordedSearch;
using search::TreeVertex;

/// From what matters least, which is covered by the others.
constexpr std::array<Fate, search::kFates> kFromBehind{Fate::kBound, Fate::kOpen, Fate::kCollision,
                                                       Fate::kExpanded, Fate::kGoal};

std::string path(const std::string& attributes, const std::string& places) {
  return places.empty() ? "" : fmt::format("<path {} d=\"{}\"/>\n", attributes, places);
}

/// Axes of the picture of the tree.
class TreeAxes {
 public:
  static constexpr double kWidth_px = 1000.0;
  static constexpr double kHeight_px = 520.0;
  static constexpr double kLeft_px = 70.0;
  static constexpr double kBottom_px = kHeight_px - 45.0;
  static constexpr double kTop_px = 15.0;

  TreeAxes(const RecordedSearch& recorded, const std::vector<std::uint32_t>& shown,
           std::size_t depths)
      : depths_(depths) {
    std::vector<double> estimates;
    for (const std::uint32_t id : shown) {
      const double estimate_m2 = recorded.tree.vertices[id].estimate_m2;
      if (std::isfinite(estimate_m2)) estimates.push_back(estimate_m2);
    }
    if (estimates.empty()) estimates = {0.0};
    std::ranges::sort(estimates);
    least_m2_ = estimates.front();
    most_m2_ = estimates[(estimates.size() - 1) * 9 / 10];
    if (recorded.result.maneuvers.empty()) return;
    // What lies far above the costs of both plans matters least.
    double cost_m2 = recorded.result.cost;
    if (const auto* second = runner_up(recorded.alternatives)) {
      cost_m2 = std::max(cost_m2, second->best.cost);
    }
    least_m2_ = std::min(least_m2_, recorded.result.cost);
    most_m2_ = std::clamp(most_m2_, cost_m2, cost_m2 + 2.0 * (cost_m2 - least_m2_));
  }

  [[nodiscard]] double column_px() const {
    return (kWidth_px - kLeft_px) / static_cast<double>(depths_);
  }
  [[nodiscard]] double x_px(double depth) const { return kLeft_px + (depth + 0.5) * column_px(); }
  [[nodiscard]] double y_px(double estimate_m2) const {
    constexpr double kMargin = 0.06;
    const double share = (estimate_m2 - least_m2_) / range_m2();
    return kBottom_px - (kMargin + (1.0 - kMargin) * std::min(share, 1.0)) * (kBottom_px - kTop_px);
  }
  [[nodiscard]] std::string svg() const {
    std::string svg;
    for (const double tick : nice_ticks(least_m2_, least_m2_ + range_m2())) {
      const double y = y_px(tick);
      svg += svg::segment({kLeft_px, y}, {kWidth_px, y}, "class=\"grid\"");
      svg += svg::text_at({kLeft_px - 6.0, y + 4.0}, fmt::format("{:.4g}", tick + 0.0), "end");
    }
    for (std::size_t depth = 0; depth < depths_; ++depth) {
      svg += svg::text_at({x_px(static_cast<double>(depth)), kBottom_px + 18.0},
                          fmt::to_string(depth), "middle");
    }
    svg += svg::text_at({x_px(0.5 * static_cast<double>(depths_ - 1)), kHeight_px - 6.0},
                        "depth: steps planned", "middle");
    return svg + svg::text_at({0.0, 0.0}, "f [m²]", "middle",
                              fmt::format(" transform=\"translate(16 {:.0f}) rotate(-90)\"",
                                          0.5 * (kTop_px + kBottom_px)));
  }

 private:
  [[nodiscard]] double range_m2() const { return std::max(most_m2_ - least_m2_, 1e-9); }

  std::size_t depths_;
  double least_m2_{};
  double most_m2_{};
};

/// Places of the vertices in the picture; spread within their depth by the golden ratio, which
/// leaves no gap and repeats nothing.
class TreePlaces {
 public:
  TreePlaces(const search::SearchTree& tree, const TreeAxes& axes) {
    constexpr double kGoldenRatio = 0.6180339887498949;
    places_.reserve(tree.vertices.size());
    std::vector<std::size_t> in_depth;
    for (const TreeVertex& vertex : tree.vertices) {
      if (vertex.depth >= in_depth.size()) in_depth.resize(vertex.depth + 1);
      const double turns = kGoldenRatio * static_cast<double>(in_depth[vertex.depth]++) + 0.5;
      const double offset = 0.7 * (turns - std::floor(turns) - 0.5);
      places_.emplace_back(axes.x_px(vertex.depth + (vertex.depth == 0 ? 0.0 : offset)),
                           axes.y_px(vertex.estimate_m2));
    }
  }
  [[nodiscard]] const Vector2d& operator[](std::uint32_t id) const { return places_[id]; }

 private:
  std::vector<Vector2d> places_;
};

std::string mark(Fate fate, const Vector2d& at) {
  if (fate == Fate::kCollision) {
    return fmt::format("M{:.1f},{:.1f}l6,6m0,-6l-6,6", at.x() - 3.0, at.y() - 3.0);
  }
  return fmt::format("M{:.1f},{:.1f}h0", at.x(), at.y());
}

std::string vertices_svg(const search::SearchTree& tree, const std::vector<std::uint32_t>& shown,
                         const TreePlaces& places) {
  std::string edges;
  std::string marks;
  for (const Fate fate : kFromBehind) {
    std::string edges_of_fate;
    std::string marks_of_fate;
    for (const std::uint32_t id : shown) {
      const TreeVertex& vertex = tree.vertices[id];
      if (vertex.fate != fate) continue;
      const Vector2d& from = places[vertex.parent];
      if (id != 0) {
        edges_of_fate += fmt::format("M{:.1f},{:.1f}L{:.1f},{:.1f}", from.x(), from.y(),
                                     places[id].x(), places[id].y());
      }
      marks_of_fate += mark(fate, places[id]);
    }
    edges += path(fmt::format("class=\"edge {}\"", to_string(fate)), edges_of_fate);
    marks += path(fmt::format("class=\"vertex {}\"", to_string(fate)), marks_of_fate);
  }
  return edges + marks;
}

std::string plan_in_tree(const char* name, const search::SearchResult& plan,
                         const search::SearchTree& tree, const TreeAxes& axes,
                         const TreePlaces& places) {
  std::string along;
  for (const std::uint32_t id : path_along(tree, plan.maneuvers)) {
    along +=
        fmt::format("{}{:.1f},{:.1f}", along.empty() ? "M" : " ", places[id].x(), places[id].y());
  }
  const double y = axes.y_px(plan.cost);
  return path(fmt::format("class=\"{}\"", name), along) +
         svg::segment({TreeAxes::kLeft_px, y}, {TreeAxes::kWidth_px, y},
                      fmt::format("class=\"cost {}\"", name));
}

/// The map in metres, y downwards.
std::string places_of(const std::vector<Point>& points_m) {
  std::string places;
  for (const Point& point_m : points_m) {
    places += fmt::format("{}{:.3f},{:.3f}", places.empty() ? "M" : " ", point_m.x(), -point_m.y());
  }
  return places;
}

std::string area(const std::string& attributes, const ConvexPolygon& area_m) {
  return path(attributes, places_of({area_m.vertices_m.begin(), area_m.vertices_m.end()}) + "z");
}

std::string edges_on_map(const search::SearchTree& tree, const std::vector<std::uint32_t>& shown) {
  std::string svg;
  for (const Fate fate : kFromBehind) {
    std::string edges;
    for (const std::uint32_t id : shown) {
      const TreeVertex& vertex = tree.vertices[id];
      if (vertex.fate != fate || id == 0) continue;
      edges += places_of({tree.vertices[vertex.parent].frame.origin_m, vertex.frame.origin_m});
    }
    svg += path(fmt::format("class=\"edge {}\"", to_string(fate)), edges);
  }
  return svg;
}

std::string plan_on_map(const char* name, const search::SearchResult& plan, const Pose& start,
                        bool with_areas) {
  std::string svg;
  std::vector<Point> along_m{start.position_m()};
  Pose from = start;
  for (std::size_t j = 0; j < plan.maneuvers.size(); ++j) {
    if (with_areas) {
      svg += area("class=\"swept\"", transformed(plan.maneuvers[j]->swept_area_m, from));
    }
    from = plan.poses[j];
    along_m.push_back(from.position_m());
  }
  if (along_m.size() > 1) svg += path(fmt::format("class=\"{}\"", name), places_of(along_m));
  return svg;
}

Eigen::AlignedBox2d extent_m(const search::HorizonProblem& problem, const RecordedSearch& recorded,
                             const std::vector<std::uint32_t>& shown) {
  Eigen::AlignedBox2d box_m(problem.start.position_m());
  for (const Point& point_m : problem.reference_m) box_m.extend(point_m);
  for (const std::uint32_t id : shown) box_m.extend(recorded.tree.vertices[id].frame.origin_m);
  const double margin_m = std::max(0.15, 0.2 * box_m.sizes().maxCoeff());
  box_m.extend(Point(box_m.max() + Point::Constant(margin_m)));
  box_m.extend(Point(box_m.min() - Point::Constant(margin_m)));
  return box_m;
}

Point middle_of(const ConvexPolygon& area_m) {
  Point sum_m = Point::Zero();
  for (const Point& corner_m : area_m.vertices_m) sum_m += corner_m;
  return sum_m / static_cast<double>(area_m.vertices_m.size());
}

/// Numbers, unless they would cover that of an area which ruled out more.
std::string numbers_on_map(const OccupiedAreas& occupied, const Eigen::AlignedBox2d& box_m) {
  const double apart_m = 0.03 * box_m.sizes().maxCoeff();
  std::vector<std::size_t> order(occupied.areas.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, std::ranges::greater{},
                           [&occupied](std::size_t i) { return occupied.areas[i].dropped; });
  std::string svg;
  std::vector<Point> taken_m;
  for (const std::size_t i : order) {
    const Point at_m = middle_of(occupied.areas[i].area_m);
    const bool is_covered = std::ranges::any_of(
        taken_m, [&](const Point& other_m) { return (other_m - at_m).norm() < apart_m; });
    if (is_covered || !box_m.contains(at_m)) continue;
    taken_m.push_back(at_m);
    svg += fmt::format("<text x=\"{:.3f}\" y=\"{:.3f}\">{}</text>\n", at_m.x(), -at_m.y(), i + 1);
  }
  return svg;
}

}  // namespace

std::string tree_picture(const RecordedSearch& recorded) {
  const std::vector<std::uint32_t> shown = vertices_to_show(recorded.tree, kMostDrawn);
  const TreeAxes axes(recorded, shown, counts_by_depth(recorded.tree).size());
  const TreePlaces places(recorded.tree, axes);
  std::string svg = fmt::format(
      "<svg class=\"tree\" role=\"img\" aria-label=\"search tree by depth and estimated cost\" "
      "viewBox=\"0 0 {:.0f} {:.0f}\">\n",
      TreeAxes::kWidth_px, TreeAxes::kHeight_px);
  svg += axes.svg() + vertices_svg(recorded.tree, shown, places);
  if (const auto* second = runner_up(recorded.alternatives)) {
    svg += plan_in_tree("second", second->best, recorded.tree, axes, places);
  }
  if (!recorded.result.maneuvers.empty()) {
    svg += plan_in_tree("winner", recorded.result, recorded.tree, axes, places);
  }
  return svg + "</svg>\n";
}

std::string search_map(const scenario::ProblemFile& file, const RecordedSearch& recorded,
                       const OccupiedAreas& occupied) {
  const search::HorizonProblem& problem = file.problem;
  const std::vector<std::uint32_t> shown = vertices_to_show(recorded.tree, kMostDrawn);
  const Eigen::AlignedBox2d box_m = extent_m(problem, recorded, shown);
  const double size_m = box_m.sizes().maxCoeff();
  std::string svg = fmt::format(
      "<svg class=\"map\" role=\"img\" aria-label=\"explored motions, obstacles, plan\" "
      "viewBox=\"{:.3f} {:.3f} {:.3f} {:.3f}\" font-size=\"{:.4f}\">\n",
      box_m.min().x(), -box_m.max().y(), box_m.sizes().x(), box_m.sizes().y(), 0.022 * size_m);
  for (const OccupiedArea& one : occupied.areas) svg += area("class=\"obstacle\"", one.area_m);
  for (const Segment& segment : problem.boundary_m) {
    svg += path("class=\"boundary\"", places_of({segment.from_m, segment.to_m}));
  }
  const Footprint& footprint = file.subgraph->automaton().vehicle.footprint;
  svg += area("class=\"car\"", footprint_area(footprint, problem.start));
  svg += edges_on_map(recorded.tree, shown);
  svg += path("class=\"reference\"", places_of(problem.reference_m));
  for (const Point& point_m : problem.reference_m) {
    svg += fmt::format("<circle class=\"reference\" cx=\"{:.3f}\" cy=\"{:.3f}\" r=\"{:.4f}\"/>\n",
                       point_m.x(), -point_m.y(), 0.006 * size_m);
  }
  if (const auto* second = runner_up(recorded.alternatives)) {
    svg += plan_on_map("second", second->best, problem.start, false);
  }
  svg += plan_on_map("winner", recorded.result, problem.start, true);
  return svg + numbers_on_map(occupied, box_m) + "</svg>\n";
}

}  // namespace hlc::plot
