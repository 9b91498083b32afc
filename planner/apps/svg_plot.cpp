#include "planner/apps/svg_plot.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace hlc {
namespace {

using Eigen::Vector2d;

constexpr double kTitleHeight_px = 40.0;
constexpr double kLeft_px = 72.0;  // room for ticks and labels around the axes
constexpr double kRight_px = 18.0;
constexpr double kTop_px = 30.0;
constexpr double kBottom_px = 52.0;
constexpr double kLegendLine_px = 16.0;

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.2f", value);
  return text;
}

/// A tick's number; what is 0 but for rounding is 0.
std::string tick_text(double value, double step) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.6g", std::abs(value) < 1e-9 * step ? 0.0 : value);
  return text;
}

std::string escaped(const std::string& text) {
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
      default:
        result += c;
    }
  }
  return result;
}

struct Box {
  Vector2d min = Vector2d::Constant(std::numeric_limits<double>::infinity());
  Vector2d max = Vector2d::Constant(-std::numeric_limits<double>::infinity());

  void add(const Vector2d& point) {
    min = min.cwiseMin(point);
    max = max.cwiseMax(point);
  }
};

Box contents_of(const PlotPanel& panel) {
  Box box;
  for (const PlotLine& line : panel.lines) {
    for (const Vector2d& point : line.points) box.add(point);
  }
  for (const PlotMark& mark : panel.marks) box.add(mark.at);
  for (const PlotText& text : panel.texts) box.add(text.at);
  for (const PlotArrow& arrow : panel.arrows) {
    box.add(arrow.from);
    box.add(arrow.to);
  }
  if (!box.min.allFinite() || !box.max.allFinite()) {
    box.min = Vector2d::Zero();
    box.max = Vector2d::Ones();
  }
  return box;
}

/// From the units of the axes to pixels.
struct Frame {
  Box range;
  Vector2d corner_px;  ///< top left of the axes
  Vector2d size_px;

  [[nodiscard]] Vector2d operator()(const Vector2d& point) const {
    const Vector2d share = (point - range.min).cwiseQuotient(range.max - range.min);
    return corner_px + Vector2d(share.x(), 1.0 - share.y()).cwiseProduct(size_px);
  }
};

Frame frame_of(const PlotPanel& panel, const Vector2d& corner_px, const Vector2d& size_px) {
  constexpr double kMargin = 0.06;
  Frame frame{contents_of(panel), corner_px, size_px};
  Vector2d width = frame.range.max - frame.range.min;
  for (Eigen::Index i = 0; i < 2; ++i) {
    const double size = std::max(std::abs(frame.range.min(i)), std::abs(frame.range.max(i)));
    if (!(width(i) > 1e-9 * size)) width(i) = size > 0.0 ? 0.2 * size : 1.0;
  }
  width *= 1.0 + 2.0 * kMargin;
  if (panel.equal_scale) {
    const double per_px = width.cwiseQuotient(size_px).maxCoeff();
    width = per_px * size_px;
  }
  const Vector2d middle = 0.5 * (frame.range.min + frame.range.max);
  frame.range.min = middle - 0.5 * width;
  frame.range.max = middle + 0.5 * width;
  return frame;
}

std::string text_at(const Vector2d& at, const std::string& text, const std::string& anchor,
                    const std::string& more = "") {
  return "<text x=\"" + number(at.x()) + "\" y=\"" + number(at.y()) + "\" text-anchor=\"" + anchor +
         "\"" + more + ">" + escaped(text) + "</text>\n";
}

std::string segment(const Vector2d& from, const Vector2d& to, const std::string& style) {
  return "<line x1=\"" + number(from.x()) + "\" y1=\"" + number(from.y()) + "\" x2=\"" +
         number(to.x()) + "\" y2=\"" + number(to.y()) + "\" " + style + "/>\n";
}

std::string axes_of(const PlotPanel& panel, const Frame& frame) {
  const std::string grid = "stroke=\"#dddddd\" stroke-width=\"0.8\"";
  const Vector2d& corner = frame.corner_px;
  const Vector2d& size = frame.size_px;
  std::string out;
  const std::vector<double> x_ticks = nice_ticks(frame.range.min.x(), frame.range.max.x());
  for (const double x : x_ticks) {
    const double at_px = frame({x, 0.0}).x();
    out += segment({at_px, corner.y()}, {at_px, corner.y() + size.y()}, grid);
    out += text_at({at_px, corner.y() + size.y() + 16.0},
                   tick_text(x, frame.range.max.x() - frame.range.min.x()), "middle");
  }
  const std::vector<double> y_ticks = nice_ticks(frame.range.min.y(), frame.range.max.y());
  for (const double y : y_ticks) {
    const double at_px = frame({0.0, y}).y();
    out += segment({corner.x(), at_px}, {corner.x() + size.x(), at_px}, grid);
    out += text_at({corner.x() - 6.0, at_px + 4.0},
                   tick_text(y, frame.range.max.y() - frame.range.min.y()), "end");
  }
  out += "<rect x=\"" + number(corner.x()) + "\" y=\"" + number(corner.y()) + "\" width=\"" +
         number(size.x()) + "\" height=\"" + number(size.y()) +
         "\" fill=\"none\" stroke=\"#444444\"/>\n";
  const double middle_px = corner.x() + 0.5 * size.x();
  out += text_at({middle_px, corner.y() - 9.0}, panel.title, "middle", " font-weight=\"bold\"");
  out += text_at({middle_px, corner.y() + size.y() + 36.0}, panel.x_label, "middle");
  const Vector2d left(corner.x() - 54.0, corner.y() + 0.5 * size.y());
  out += text_at(left, panel.y_label, "middle",
                 " transform=\"rotate(-90 " + number(left.x()) + " " + number(left.y()) + ")\"");
  return out;
}

std::string line_of(const PlotLine& line, const Frame& frame) {
  std::string points;
  for (const Vector2d& point : line.points) {
    const Vector2d at = frame(point);
    points += number(at.x()) + "," + number(at.y()) + " ";
  }
  return "<polyline fill=\"none\" stroke=\"" + line.colour + "\" stroke-width=\"" +
         number(line.width_px) + "\"" +
         (line.stroke == Stroke::kDashed ? " stroke-dasharray=\"5 4\"" : "") + " points=\"" +
         points + "\"/>\n";
}

std::string mark_at(const Vector2d& at, Mark mark, const std::string& colour, double radius) {
  if (mark == Mark::kCross) {
    const std::string style = "stroke=\"" + colour + "\" stroke-width=\"1.2\"";
    return segment(at + Vector2d(-radius, -radius), at + Vector2d(radius, radius), style) +
           segment(at + Vector2d(-radius, radius), at + Vector2d(radius, -radius), style);
  }
  const bool is_ring = mark == Mark::kRing;
  return "<circle cx=\"" + number(at.x()) + "\" cy=\"" + number(at.y()) + "\" r=\"" +
         number(radius) + "\" fill=\"" + (is_ring ? "none" : colour) + "\" stroke=\"" + colour +
         "\" stroke-width=\"" + (is_ring ? "1.8" : "0.5") + "\"/>\n";
}

std::string head_of(const Vector2d& tip, const Vector2d& along, const std::string& colour) {
  const Vector2d across(-along.y(), along.x());
  const Vector2d a = tip - 8.0 * along + 3.2 * across;
  const Vector2d b = tip - 8.0 * along - 3.2 * across;
  return "<polygon fill=\"" + colour + "\" points=\"" + number(tip.x()) + "," + number(tip.y()) +
         " " + number(a.x()) + "," + number(a.y()) + " " + number(b.x()) + "," + number(b.y()) +
         "\"/>\n";
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

std::string legend_of(const PlotPanel& panel, const Frame& frame) {
  constexpr double kCharacter_px = 7.2;
  std::size_t longest = 0;
  for (const PlotLegend& entry : panel.legend) longest = std::max(longest, entry.text.size());
  const Vector2d size(34.0 + kCharacter_px * static_cast<double>(longest),
                      8.0 + kLegendLine_px * static_cast<double>(panel.legend.size()));
  const bool is_left =
      panel.legend_corner == Corner::kTopLeft || panel.legend_corner == Corner::kBottomLeft;
  const bool is_top =
      panel.legend_corner == Corner::kTopLeft || panel.legend_corner == Corner::kTopRight;
  const Vector2d low = frame.corner_px + Vector2d(8.0, 8.0);
  const Vector2d high = frame.corner_px + frame.size_px - size - Vector2d(8.0, 8.0);
  const Vector2d corner(is_left ? low.x() : high.x(), is_top ? low.y() : high.y());
  std::string out = "<rect x=\"" + number(corner.x()) + "\" y=\"" + number(corner.y()) +
                    "\" width=\"" + number(size.x()) + "\" height=\"" + number(size.y()) +
                    "\" fill=\"#ffffff\" fill-opacity=\"0.85\" stroke=\"#bbbbbb\"/>\n";
  for (std::size_t i = 0; i < panel.legend.size(); ++i) {
    const PlotLegend& entry = panel.legend[i];
    const Vector2d at = corner + Vector2d(14.0, 12.0 + kLegendLine_px * static_cast<double>(i));
    out += entry.radius_px > 0.0 ? mark_at(at, entry.mark, entry.colour, entry.radius_px)
                                 : segment(at - Vector2d(8.0, 0.0), at + Vector2d(8.0, 0.0),
                                           "stroke=\"" + entry.colour + "\" stroke-width=\"2\"");
    out += text_at(at + Vector2d(14.0, 4.0), entry.text, "start");
  }
  return out;
}

std::string panel_at(const PlotPanel& panel, const Vector2d& corner_px, const PlotSize& size) {
  const Frame frame = frame_of(
      panel, corner_px + Vector2d(kLeft_px, kTop_px),
      Vector2d(size.width_px - kLeft_px - kRight_px, size.height_px - kTop_px - kBottom_px));
  std::string out = "<g>\n" + axes_of(panel, frame);
  for (const PlotLine& line : panel.lines) out += line_of(line, frame);
  for (const PlotArrow& arrow : panel.arrows) out += arrow_of(arrow, frame);
  for (const PlotMark& mark : panel.marks) {
    out += mark_at(frame(mark.at), mark.mark, mark.colour, mark.radius_px);
  }
  for (const PlotText& text : panel.texts) {
    out += text_at(frame(text.at) + Vector2d(0.0, 4.0), text.text, "middle");
  }
  if (!panel.legend.empty()) out += legend_of(panel, frame);
  return out + "</g>\n";
}

}  // namespace

std::string svg_of(const std::string& title, const std::vector<PlotPanel>& panels,
                   std::size_t columns, const PlotSize& panel) {
  const std::size_t rows = (panels.size() + columns - 1) / columns;
  const std::string width = number(panel.width_px * static_cast<double>(columns));
  const std::string height = number(kTitleHeight_px + panel.height_px * static_cast<double>(rows));
  std::string out = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + width + "\" height=\"" +
                    height + "\" viewBox=\"0 0 " + width + " " + height +
                    "\" font-family=\"sans-serif\" font-size=\"12\">\n" +
                    "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n";
  out += text_at({0.5 * panel.width_px * static_cast<double>(columns), 26.0}, title, "middle",
                 " font-size=\"16\"");
  for (std::size_t i = 0; i < panels.size(); ++i) {
    const Vector2d corner(panel.width_px * static_cast<double>(i % columns),
                          kTitleHeight_px + panel.height_px * static_cast<double>(i / columns));
    out += panel_at(panels[i], corner, panel);
  }
  return out + "</svg>\n";
}

std::vector<double> nice_ticks(double min, double max, std::size_t count) {
  const double rough = (max - min) / static_cast<double>(std::max<std::size_t>(count, 1));
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  double step = 10.0 * power;
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= rough) {
      step = factor * power;
      break;
    }
  }
  std::vector<double> ticks;
  const double last = std::floor(max / step + 1e-9);
  for (double i = std::ceil(min / step - 1e-9); i <= last; i += 1.0) {
    ticks.push_back(i * step);
  }
  return ticks;
}

std::string red_to_blue(double share) {
  const double s = std::clamp(share, 0.0, 1.0);
  const auto byte = [](double value) { return static_cast<int>(std::lround(value)); };
  char text[32];
  std::snprintf(text, sizeof(text), "#%02x%02x%02x", byte(214.0 * (1.0 - s) + 20.0 * s),
                byte(30.0 + 40.0 * s), byte(35.0 * (1.0 - s) + 215.0 * s));
  return text;
}

}  // namespace hlc
