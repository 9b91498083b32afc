#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <string>

#include "planner/plot/svg_plot.hpp"

/// From the units of a panel's axes to pixels.
namespace hlc::plot::svg {

using Range = Eigen::AlignedBox2d;

/// A point on the axes, as logarithms on logarithmic ones.
[[nodiscard]] Eigen::Vector2d on_axes(const PlotPanel& panel, const Eigen::Vector2d& point);

/// Calls `visit` with every point of the panel's content.
template <class Visit>
void for_each_point(const PlotPanel& panel, const Visit& visit) {
  for (const auto* areas : {&panel.areas, &panel.front_areas}) {
    for (const PlotArea& area : *areas) std::ranges::for_each(area.points, visit);
  }
  for (const PlotLine& line : panel.lines) std::ranges::for_each(line.points, visit);
  for (const PlotMark& mark : panel.marks) visit(mark.at);
  for (const PlotText& text : panel.texts) visit(text.at);
  for (const PlotArrow& arrow : panel.arrows) {
    visit(arrow.from);
    visit(arrow.to);
  }
}

/// Place and range of a panel's axes.
struct Frame {
  const PlotPanel& panel;
  Range range;                ///< of logarithms if an axis is logarithmic
  Eigen::Vector2d corner_px;  ///< top left of the axes
  Eigen::Vector2d size_px;

  [[nodiscard]] Eigen::Vector2d operator()(const Eigen::Vector2d& point) const {
    return at(on_axes(panel, point));
  }
  [[nodiscard]] Eigen::Vector2d at(const Eigen::Vector2d& on_axes) const {
    const Eigen::Vector2d share = (on_axes - range.min()).cwiseQuotient(range.sizes());
    return corner_px + Eigen::Vector2d(share.x(), 1.0 - share.y()).cwiseProduct(size_px);
  }
};

/// The panel's own range, or that of its content with a margin.
[[nodiscard]] Frame frame_of(const PlotPanel& panel, const Eigen::Vector2d& corner_px,
                             const Eigen::Vector2d& size_px);

/// Grid, ticks, labels and title of the panel.
[[nodiscard]] std::string axes_of(const Frame& frame);

}  // namespace hlc::plot::svg
