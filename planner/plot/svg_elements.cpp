#include "planner/plot/svg_elements.hpp"

#include <tinyxml2.h>

#include <cstdio>

namespace hlc::plot::svg {
namespace {

using Eigen::Vector2d;

std::string escaped(const std::string& text) {
  tinyxml2::XMLPrinter printer;
  printer.PushText(text.c_str());
  return printer.CStr();
}

}  // namespace

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.2f", value);
  return text;
}

std::string text_at(const Vector2d& at, const std::string& text, const std::string& anchor,
                    const std::string& more) {
  return "<text x=\"" + number(at.x()) + "\" y=\"" + number(at.y()) + "\" text-anchor=\"" + anchor +
         "\"" + more + ">" + escaped(text) + "</text>\n";
}

std::string segment(const Vector2d& from, const Vector2d& to, const std::string& style) {
  return "<line x1=\"" + number(from.x()) + "\" y1=\"" + number(from.y()) + "\" x2=\"" +
         number(to.x()) + "\" y2=\"" + number(to.y()) + "\" " + style + "/>\n";
}

std::string rectangle(const Vector2d& corner, const Vector2d& size, const std::string& style) {
  return "<rect x=\"" + number(corner.x()) + "\" y=\"" + number(corner.y()) + "\" width=\"" +
         number(size.x()) + "\" height=\"" + number(size.y()) + "\"" + style + "/>\n";
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

std::string dashes_of(Stroke stroke) {
  return stroke == Stroke::kDashed ? " stroke-dasharray=\"5 4\"" : "";
}

}  // namespace hlc::plot::svg
