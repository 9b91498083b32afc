#include "planner/plot/svg_elements.hpp"

#include <fmt/format.h>
#include <tinyxml2.h>

namespace hlc::plot::svg {

using Eigen::Vector2d;

std::string escaped(const std::string& text) {
  tinyxml2::XMLPrinter printer;
  printer.PushText(text.c_str());
  return printer.CStr();
}

std::string text_at(const Vector2d& at, const std::string& text, const std::string& anchor,
                    const std::string& more) {
  return fmt::format("<text x=\"{:.2f}\" y=\"{:.2f}\" text-anchor=\"{}\"{}>{}</text>\n", at.x(),
                     at.y(), anchor, more, escaped(text));
}

std::string segment(const Vector2d& from, const Vector2d& to, const std::string& style) {
  return fmt::format("<line x1=\"{:.2f}\" y1=\"{:.2f}\" x2=\"{:.2f}\" y2=\"{:.2f}\" {}/>\n",
                     from.x(), from.y(), to.x(), to.y(), style);
}

std::string rectangle(const Vector2d& corner, const Vector2d& size, const std::string& style) {
  return fmt::format("<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\"{}/>\n",
                     corner.x(), corner.y(), size.x(), size.y(), style);
}

std::string mark_at(const Vector2d& at, Mark mark, const std::string& colour, double radius) {
  if (mark == Mark::kCross) {
    const std::string style = fmt::format("stroke=\"{}\" stroke-width=\"1.2\"", colour);
    return segment(at + Vector2d(-radius, -radius), at + Vector2d(radius, radius), style) +
           segment(at + Vector2d(-radius, radius), at + Vector2d(radius, -radius), style);
  }
  const bool is_ring = mark == Mark::kRing;
  return fmt::format(
      "<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"{:.2f}\" fill=\"{}\" stroke=\"{}\" "
      "stroke-width=\"{}\"/>\n",
      at.x(), at.y(), radius, is_ring ? "none" : colour, colour, is_ring ? "1.8" : "0.5");
}

std::string dashes_of(Stroke stroke) {
  return stroke == Stroke::kDashed ? " stroke-dasharray=\"5 4\"" : "";
}

}  // namespace hlc::plot::svg
