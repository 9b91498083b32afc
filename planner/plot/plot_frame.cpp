#include "planner/plot/plot_frame.hpp"

#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "planner/plot/svg_elements.hpp"
#include "planner/plot/ticks.hpp"

namespace hlc::plot::svg {
namespace {

using Eigen::Vector2d;

Range contents_of(const PlotPanel& panel) {
  Range box;
  for_each_point(panel, [&](const Eigen::Vector2d& point) { box.extend(on_axes(panel, point)); });
  if (box.isEmpty()) box = Range(Eigen::Vector2d::Zero(), Eigen::Vector2d::Ones());
  return box;
}

/// Avoids a width of 0.
Eigen::Vector2d widened(const Range& range) {
  Eigen::Vector2d width = range.sizes();
  for (Eigen::Index i = 0; i < 2; ++i) {
    const double size = std::max(std::abs(range.min()(i)), std::abs(range.max()(i)));
    if (!(width(i) > 1e-9 * size)) width(i) = size > 0.0 ? 0.2 * size : 1.0;
  }
  return width;
}

/// A tick's number; rounding errors around 0 become 0.
std::string tick_text(double value, double step) {
  return fmt::format("{:.6g}", std::abs(value) < 1e-9 * step ? 0.0 : value);
}

struct Tick {
  double place{};  ///< on the axis: the logarithm if it is logarithmic
  std::string text;
};

std::vector<Tick> ticks_of(Scale scale, double min, double max) {
  std::vector<Tick> ticks;
  if (scale == Scale::kLog) {
    for (const double value : log_ticks(std::pow(10.0, min), std::pow(10.0, max))) {
      ticks.push_back({std::log10(value), tick_text(value, value)});
    }
  } else {
    for (const double value : nice_ticks(min, max)) {
      ticks.push_back({value, tick_text(value, max - min)});
    }
  }
  return ticks;
}

}  // namespace

Eigen::Vector2d on_axes(const PlotPanel& panel, const Eigen::Vector2d& point) {
  return {panel.x_scale == Scale::kLog ? std::log10(point.x()) : point.x(),
          panel.y_scale == Scale::kLog ? std::log10(point.y()) : point.y()};
}

Frame frame_of(const PlotPanel& panel, const Eigen::Vector2d& corner_px,
               const Eigen::Vector2d& size_px) {
  constexpr double kMargin = 0.06;
  Frame frame{panel, contents_of(panel), corner_px, size_px};
  Eigen::Vector2d width = (1.0 + 2.0 * kMargin) * widened(frame.range);
  if (panel.range) {
    frame.range = Range(on_axes(panel, panel.range->min()), on_axes(panel, panel.range->max()));
    width = frame.range.sizes();
  }
  if (panel.equal_scale) width = width.cwiseQuotient(size_px).maxCoeff() * size_px;
  const Eigen::Vector2d middle = frame.range.center();
  frame.range = Range(middle - 0.5 * width, middle + 0.5 * width);
  return frame;
}

std::string axes_of(const Frame& frame) {
  const PlotPanel& panel = frame.panel;
  const std::string grid = "stroke=\"#dddddd\" stroke-width=\"0.8\"";
  const Vector2d& corner = frame.corner_px;
  const Vector2d& size = frame.size_px;
  std::string out;
  for (const Tick& x : ticks_of(panel.x_scale, frame.range.min().x(), frame.range.max().x())) {
    const double at_px = frame.at({x.place, 0.0}).x();
    out += segment({at_px, corner.y()}, {at_px, corner.y() + size.y()}, grid);
    out += text_at({at_px, corner.y() + size.y() + 16.0}, x.text, "middle");
  }
  for (const Tick& y : ticks_of(panel.y_scale, frame.range.min().y(), frame.range.max().y())) {
    const double at_px = frame.at({0.0, y.place}).y();
    out += segment({corner.x(), at_px}, {corner.x() + size.x(), at_px}, grid);
    out += text_at({corner.x() - 6.0, at_px + 4.0}, y.text, "end");
  }
  const double middle_px = corner.x() + 0.5 * size.x();
  out += text_at({middle_px, corner.y() - 9.0}, panel.title, "middle", " font-weight=\"bold\"");
  out += text_at({middle_px, corner.y() + size.y() + 36.0}, panel.x_label, "middle");
  const Vector2d left(corner.x() - 54.0, corner.y() + 0.5 * size.y());
  out += text_at(left, panel.y_label, "middle",
                 fmt::format(" transform=\"rotate(-90 {:.2f} {:.2f})\"", left.x(), left.y()));
  return out;
}

}  // namespace hlc::plot::svg
