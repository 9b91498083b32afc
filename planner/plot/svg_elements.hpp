#pragma once

#include <Eigen/Core>
#include <string>

#include "planner/plot/svg_plot.hpp"

/// The SVG elements of plots, at places in pixels (x to the right, y down).
namespace hlc::plot::svg {

/// The text with & < > as entities, for text between tags, also of HTML.
[[nodiscard]] std::string escaped(const std::string& text);

/// @param anchor  start, middle or end: the part of the text at the place
/// @param more    further attributes, beginning with a blank
[[nodiscard]] std::string text_at(const Eigen::Vector2d& at, const std::string& text,
                                  const std::string& anchor, const std::string& more = "");

/// @param style  attributes
[[nodiscard]] std::string segment(const Eigen::Vector2d& from, const Eigen::Vector2d& to,
                                  const std::string& style);

/// @param style  attributes, beginning with a blank
[[nodiscard]] std::string rectangle(const Eigen::Vector2d& corner, const Eigen::Vector2d& size,
                                    const std::string& style);

[[nodiscard]] std::string mark_at(const Eigen::Vector2d& at, Mark mark, const std::string& colour,
                                  double radius);

/// The attribute of a stroke's dashes, beginning with a blank; nothing if it is solid.
[[nodiscard]] std::string dashes_of(Stroke stroke);

}  // namespace hlc::plot::svg
