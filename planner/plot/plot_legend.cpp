#include "planner/plot/plot_legend.hpp"

#include <algorithm>
#include <array>

#include "planner/plot/svg_elements.hpp"

namespace hlc::plot::svg {
namespace {

using Eigen::Vector2d;

constexpr double kLegendLine_px = 16.0;

double entry_width_px(const PlotLegend& entry) {
  constexpr double kCharacter_px = 7.0;
  return 34.0 + kCharacter_px * static_cast<double>(entry.text.size());
}

std::string entry_at(const Vector2d& at, const PlotLegend& entry) {
  const std::string mark =
      entry.radius_px > 0.0
          ? mark_at(at, entry.mark, entry.colour, entry.radius_px)
          : segment(at - Vector2d(9.0, 0.0), at + Vector2d(9.0, 0.0),
                    "stroke=\"" + entry.colour + "\" stroke-width=\"2\"" + dashes_of(entry.stroke));
  return mark + text_at(at + Vector2d(14.0, 4.0), entry.text, "start");
}

Vector2d legend_size_px(const PlotPanel& panel) {
  double width_px = 0.0;
  for (const PlotLegend& entry : panel.legend) width_px = std::max(width_px, entry_width_px(entry));
  return {width_px, 8.0 + kLegendLine_px * static_cast<double>(panel.legend.size())};
}

/// Position of the legend in a corner of the axes.
Range legend_box(const PlotPanel& panel, const Frame& frame, Corner corner) {
  const Vector2d size = legend_size_px(panel);
  const bool is_left = corner == Corner::kTopLeft || corner == Corner::kBottomLeft;
  const bool is_top = corner == Corner::kTopLeft || corner == Corner::kTopRight;
  const Vector2d low = frame.corner_px + Vector2d(8.0, 8.0);
  const Vector2d high = frame.corner_px + frame.size_px - size - Vector2d(8.0, 8.0);
  const Vector2d place(is_left ? low.x() : high.x(), is_top ? low.y() : high.y());
  return {place, place + size};
}

/// Amount of the panel's content behind a box: points, and pieces of lines a few pixels long.
std::size_t hidden_by(const Range& box, const PlotPanel& panel, const Frame& frame) {
  constexpr double kPiece_px = 4.0;
  std::size_t count = 0;
  for_each_point(panel, [&](const Vector2d& at) { count += box.contains(frame(at)) ? 1U : 0U; });
  for (const PlotLine& line : panel.lines) {
    for (std::size_t i = 1; i < line.points.size(); ++i) {
      const Vector2d from = frame(line.points[i - 1]);
      const Vector2d along = frame(line.points[i]) - from;
      const auto pieces = static_cast<std::size_t>(std::min(1e4, along.norm() / kPiece_px));
      for (std::size_t j = 1; j < pieces; ++j) {
        const double share = static_cast<double>(j) / static_cast<double>(pieces);
        if (box.contains(from + share * along)) ++count;
      }
    }
  }
  return count;
}

Corner corner_of(const PlotPanel& panel, const Frame& frame) {
  if (panel.legend_corner != Corner::kEmptiest) return panel.legend_corner;
  constexpr std::array kCorners{Corner::kTopRight, Corner::kTopLeft, Corner::kBottomRight,
                                Corner::kBottomLeft};
  return *std::ranges::min_element(kCorners, {}, [&](Corner corner) {
    return hidden_by(legend_box(panel, frame, corner), panel, frame);
  });
}

}  // namespace

std::string legend_of(const Frame& frame) {
  const PlotPanel& panel = frame.panel;
  const Range box = legend_box(panel, frame, corner_of(panel, frame));
  std::string out = rectangle(box.min(), box.sizes(),
                              " fill=\"#ffffff\" fill-opacity=\"0.85\" stroke=\"#bbbbbb\"");
  for (std::size_t i = 0; i < panel.legend.size(); ++i) {
    out += entry_at(box.min() + Vector2d(14.0, 12.0 + kLegendLine_px * static_cast<double>(i)),
                    panel.legend[i]);
  }
  return out;
}

std::vector<std::vector<PlotLegend>> rows_of(const std::vector<PlotLegend>& legend,
                                             double width_px) {
  std::vector<std::vector<PlotLegend>> rows;
  double left_px = 0.0;
  for (const PlotLegend& entry : legend) {
    left_px -= entry_width_px(entry);
    if (left_px < 0.0) {
      rows.emplace_back();
      left_px = width_px - entry_width_px(entry);
    }
    rows.back().push_back(entry);
  }
  return rows;
}

std::string legend_row(const std::vector<PlotLegend>& row, const Vector2d& middle_px) {
  double width_px = 0.0;
  for (const PlotLegend& entry : row) width_px += entry_width_px(entry);
  std::string out;
  double x_px = middle_px.x() - 0.5 * width_px;
  for (const PlotLegend& entry : row) {
    out += entry_at({x_px + 14.0, middle_px.y()}, entry);
    x_px += entry_width_px(entry);
  }
  return out;
}

}  // namespace hlc::plot::svg
