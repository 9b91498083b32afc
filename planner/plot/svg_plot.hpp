#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

namespace hlc::plot {

/// A small writer of plots as SVG: panels with axes, ticks, areas, lines, dots, arrows and a
/// legend. The same input gives the same bytes.

enum class Stroke { kSolid, kDashed };

struct PlotLine {
  std::vector<Eigen::Vector2d> points;  ///< in the units of the axes
  std::string colour{"#000000"};
  double width_px{1.4};
  Stroke stroke{Stroke::kSolid};
};

/// A filled polygon.
struct PlotArea {
  std::vector<Eigen::Vector2d> points;  ///< not closed
  std::string fill{"#eeeeee"};
  std::string stroke{"none"};
  double stroke_width_px{1.0};
};

enum class Mark { kDot, kRing, kCross };

struct PlotMark {
  Eigen::Vector2d at;
  std::string colour{"#000000"};
  Mark mark{Mark::kDot};
  double radius_px{3.5};
};

/// A straight arrow that ends `gap_px` before both points, to leave room for marks; shifted by
/// `shift_px` to its left, so that several fit side by side.
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
  std::string text;  ///< position of its middle
  std::string colour{"#000000"};
};

/// One entry of a legend: a mark, or a line if the radius is 0.
struct PlotLegend {
  std::string text;
  std::string colour{"#000000"};
  Mark mark{Mark::kDot};
  double radius_px{3.5};
  Stroke stroke{Stroke::kSolid};
};

/// Corner of the legend in a panel. kEmptiest: the one with the least content.
enum class Corner { kTopLeft, kTopRight, kBottomLeft, kBottomRight, kEmptiest };

enum class Scale { kLinear, kLog };

/// One pair of axes. Its ranges are those of its content, with a margin, or `range`; content
/// outside is cut off.
/// @pre numbers on a logarithmic axis are above 0
struct PlotPanel {
  std::string title;
  std::string x_label;  ///< with unit
  std::string y_label;
  Scale x_scale{Scale::kLinear};
  Scale y_scale{Scale::kLinear};
  bool equal_scale{false};  ///< one unit is as long on both axes; one range grows for that
  std::optional<Eigen::AlignedBox2d> range;  ///< in the units of the axes
  std::vector<PlotArea> areas;               ///< behind everything
  std::vector<PlotArea> front_areas;         ///< in front of lines and arrows
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

/// The panels row by row, `columns` in each row, below a title and a legend for all of them.
/// @pre columns >= 1
[[nodiscard]] std::string svg_of(const std::string& title, const std::vector<PlotPanel>& panels,
                                 std::size_t columns, const PlotSize& panel = {},
                                 const std::vector<PlotLegend>& legend = {});

/// Ten colours for series; repeated after the last.
[[nodiscard]] std::string series_colour(std::size_t series);

}  // namespace hlc::plot
