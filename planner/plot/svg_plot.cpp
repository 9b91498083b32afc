#include "planner/plot/svg_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "planner/plot/plot_frame.hpp"
#include "planner/plot/plot_legend.hpp"
#include "planner/plot/svg_elements.hpp"

namespace hlc::plot {
namespace {

using Eigen::Vector2d;
using namespace svg;

constexpr double kTitleHeight_px = 40.0;
constexpr double kLeft_px = 72.0;  // room for ticks and labels around the axes
constexpr double kRight_px = 18.0;
constexpr double kTop_px = 30.0;
constexpr double kBottom_px = 52.0;
constexpr double kLegendRow_px = 24.0;  // below the title

std::string points_of(const std::vector<Vector2d>& points, const Frame& frame) {
  std::string text;
  for (const Vector2d& point : points) {
    const Vector2d at = frame(point);
    text += fmt::format("{:.2f},{:.2f} ", at.x(), at.y());
  }
  return "points=\"" + text + "\"";
}

std::string area_of(const PlotArea& area, const Frame& frame) {
  return fmt::format("<polygon fill=\"{}\" stroke=\"{}\" stroke-width=\"{:.2f}\" {}/>\n", area.fill,
                     area.stroke, area.stroke_width_px, points_of(area.points, frame));
}

std::string line_of(const PlotLine& line, const Frame& frame) {
  return fmt::format("<polyline fill=\"none\" stroke=\"{}\" stroke-width=\"{:.2f}\"{} {}/>\n",
                     line.colour, line.width_px, dashes_of(line.stroke),
                     points_of(line.points, frame));
}

std::string head_of(const Vector2d& tip, const Vector2d& along, const std::string& colour) {
  const Vector2d across(-along.y(), along.x());
  const Vector2d a = tip - 8.0 * along + 3.2 * across;
  const Vector2d b = tip - 8.0 * along - 3.2 * across;
  return fmt::format(
      "<polygon fill=\"{}\" points=\"{:.2f},{:.2f} {:.2f},{:.2f} {:.2f},{:.2f}\"/>\n", colour,
      tip.x(), tip.y(), a.x(), a.y(), b.x(), b.y());
}

std::string arrow_of(const PlotArrow& arrow, const Frame& frame) {
  Vector2d from = frame(arrow.from);
  Vector2d to = frame(arrow.to);
  const double length = (to - from).norm();
  if (length <= 2.0 * arrow.gap_px) return "";
  const Vector2d along = (to - from) / length;
  const Vector2d left(along.y(), -along.x());  // y runs down
  from += arrow.gap_px * along + arrow.shift_px * left;
  to += -arrow.gap_px * along + arrow.shift_px * left;
  return segment(from, to, "stroke=\"" + arrow.colour + "\" stroke-width=\"1.1\"") +
         head_of(to, along, arrow.colour) +
         (arrow.both_ends ? head_of(from, -along, arrow.colour) : "");
}

std::string contents_as_svg(const PlotPanel& panel, const Frame& frame) {
  std::string out;
  for (const PlotArea& area : panel.areas) out += area_of(area, frame);
  for (const PlotLine& line : panel.lines) out += line_of(line, frame);
  for (const PlotArrow& arrow : panel.arrows) out += arrow_of(arrow, frame);
  for (const PlotArea& area : panel.front_areas) out += area_of(area, frame);
  for (const PlotMark& mark : panel.marks) {
    out += mark_at(frame(mark.at), mark.mark, mark.colour, mark.radius_px);
  }
  for (const PlotText& text : panel.texts) {
    out += text_at(frame(text.at) + Vector2d(0.0, 4.0), text.text, "middle",
                   " fill=\"" + text.colour + "\"");
  }
  return out;
}

/// @param number_of  index of this panel in the picture, for a unique name
std::string panel_at(const PlotPanel& panel, const Vector2d& corner_px, const PlotSize& size,
                     std::size_t number_of) {
  const Frame frame = frame_of(
      panel, corner_px + Vector2d(kLeft_px, kTop_px),
      Vector2d(size.width_px - kLeft_px - kRight_px, size.height_px - kTop_px - kBottom_px));
  std::string out = "<g>\n" + axes_of(frame);
  if (panel.range) {
    out += fmt::format(
        "<clipPath id=\"axes{0}\">{1}</clipPath>\n<g clip-path=\"url(#axes{0})\">\n{2}</g>\n",
        number_of, rectangle(frame.corner_px, frame.size_px, ""), contents_as_svg(panel, frame));
  } else {
    out += contents_as_svg(panel, frame);
  }
  out += rectangle(frame.corner_px, frame.size_px, " fill=\"none\" stroke=\"#444444\"");
  if (!panel.legend.empty()) out += legend_of(frame);
  return out + "</g>\n";
}

}  // namespace

std::string svg_of(const std::string& title, const std::vector<PlotPanel>& panels,
                   std::size_t columns, const PlotSize& panel,
                   const std::vector<PlotLegend>& legend) {
  const std::size_t rows = (panels.size() + columns - 1) / columns;
  const double width_px = panel.width_px * static_cast<double>(columns);
  const std::vector<std::vector<PlotLegend>> legend_rows = rows_of(legend, width_px);
  const double top_px = kTitleHeight_px + kLegendRow_px * static_cast<double>(legend_rows.size());
  std::string out = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.2f}\" height=\"{1:.2f}\" "
      "viewBox=\"0 0 {0:.2f} {1:.2f}\" font-family=\"sans-serif\" font-size=\"12\">\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n",
      width_px, top_px + panel.height_px * static_cast<double>(rows));
  out += text_at({0.5 * width_px, 26.0}, title, "middle", " font-size=\"16\"");
  for (std::size_t i = 0; i < legend_rows.size(); ++i) {
    out += legend_row(
        legend_rows[i],
        {0.5 * width_px, kTitleHeight_px + kLegendRow_px * (static_cast<double>(i) + 0.5)});
  }
  for (std::size_t i = 0; i < panels.size(); ++i) {
    const Vector2d corner(panel.width_px * static_cast<double>(i % columns),
                          top_px + panel.height_px * static_cast<double>(i / columns));
    out += panel_at(panels[i], corner, panel, i);
  }
  return out + "</svg>\n";
}

std::string series_colour(std::size_t series) {
  constexpr std::array kColours{"#1f4fd8", "#d62728", "#2ca02c", "#8e44ad", "#e67e22",
                                "#16a085", "#7f8c8d", "#c2185b", "#6b3e1e", "#e0c000"};
  return kColours.at(series % kColours.size());
}

}  // namespace hlc::plot
