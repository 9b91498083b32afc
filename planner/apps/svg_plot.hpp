#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace hlc {

/// A small writer of plots as SVG: panels with axes, ticks, lines, dots, arrows and a legend. The
/// same input gives the same bytes.

enum class Stroke { kSolid, kDashed };

struct PlotLine {
  std::vector<Eigen::Vector2d> points;  ///< in the units of the axes
  std::string colour{"#000000"};
  double width_px{1.4};
  Stroke stroke{Stroke::kSolid};
};

enum class Mark { kDot, kRing, kCross };

struct PlotMark {
  Eigen::Vector2d at;
  std::string colour{"#000000"};
  Mark mark{Mark::kDot};
  double radius_px{3.5};
};

/// A straight arrow that stops `gap_px` short of both points, for marks that stand there; shifted
/// by `shift_px` to its left, so that several fit side by side.
struct PlotArrow {
  Eigen::Vector2d from;
  Eigen::Vector2d to;
  std::string colour{"#000000"};
  bool both_ends{false};
  double gap_px{0.0};
  double shift_px{0.0};
};

struct PlotText {
  Eigen::Vector2d at;
  std::string text;
};

/// One entry of a legend: a mark, or a line if the radius is 0.
struct PlotLegend {
  std::string text;
  std::string colour{"#000000"};
  Mark mark{Mark::kDot};
  double radius_px{3.5};
};

/// Where in a panel the legend stands.
enum class Corner { kTopLeft, kTopRight, kBottomLeft, kBottomRight };

/// One pair of axes. Its ranges are those of what it shows, with a margin.
struct PlotPanel {
  std::string title;
  std::string x_label;  ///< with unit
  std::string y_label;
  bool equal_scale{false};  ///< one unit is as long on both axes
  std::vector<PlotLine> lines;
  std::vector<PlotArrow> arrows;
  std::vector<PlotMark> marks;
  std::vector<PlotText> texts;
  std::vector<PlotLegend> legend;
  Corner legend_corner{Corner::kTopRight};
};

struct PlotSize {
  double width_px{420.0};
  double height_px{330.0};
};

/// The panels row by row, `columns` in each row, below a title. @pre columns >= 1
[[nodiscard]] std::string svg_of(const std::string& title, const std::vector<PlotPanel>& panels,
                                 std::size_t columns, const PlotSize& panel = {});

/// Round numbers (1, 2 or 5 times a power of ten apart) that cover [min, max], about `count` of
/// them, from the first at or above min to the last at or below max. @pre min < max
[[nodiscard]] std::vector<double> nice_ticks(double min, double max, std::size_t count = 6);

/// From red (0) over violet to blue (1), as "#rrggbb".
[[nodiscard]] std::string red_to_blue(double share);

}  // namespace hlc
