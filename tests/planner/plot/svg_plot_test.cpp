#include "planner/plot/svg_plot.hpp"

#include <gtest/gtest.h>
#include <tinyxml2.h>

namespace hlc::plot {
namespace {

PlotPanel panel_with_everything() {
  PlotPanel panel;
  panel.title = "a < b & c";
  panel.x_label = "x [m]";
  panel.y_label = "y [m]";
  panel.lines = {{{{0.0, 0.0}, {1.0, 2.0}, {3.0, -1.0}}, "#112233", 2.0, Stroke::kDashed}};
  panel.arrows = {{{0.0, 0.0}, {3.0, 2.0}, "#445566", true, 5.0, 2.0}};
  panel.marks = {{{1.0, 1.0}, "#778899", Mark::kRing}, {{2.0, 1.0}, "#778899", Mark::kCross}};
  panel.texts = {{{2.0, 2.0}, "here"}};
  panel.legend = {{"first", "#112233", Mark::kDot, 0.0}, {"second", "#778899", Mark::kRing}};
  return panel;
}

int count(const tinyxml2::XMLElement* element, const std::string& name) {
  int sum = element->Name() == name ? 1 : 0;
  for (const auto* child = element->FirstChildElement(); child != nullptr;
       child = child->NextSiblingElement()) {
    sum += count(child, name);
  }
  return sum;
}

TEST(SvgPlot, IsWellFormedXmlWithAllThatWasAskedFor) {
  const std::string svg = svg_of("title", {panel_with_everything(), {}, {}}, 2);
  tinyxml2::XMLDocument document;
  ASSERT_EQ(document.Parse(svg.c_str()), tinyxml2::XML_SUCCESS) << document.ErrorStr();
  const tinyxml2::XMLElement* root = document.RootElement();
  EXPECT_STREQ(root->Name(), "svg");
  EXPECT_DOUBLE_EQ(root->DoubleAttribute("width"), 840.0);
  EXPECT_DOUBLE_EQ(root->DoubleAttribute("height"), 700.0);
  EXPECT_EQ(count(root, "g"), 3);
  EXPECT_EQ(count(root, "polyline"), 1);
  EXPECT_EQ(count(root, "polygon"), 2);  // both heads of the arrow
  EXPECT_EQ(count(root, "circle"), 2);   // ring and its entry in the legend
  EXPECT_NE(svg.find("a &lt; b &amp; c"), std::string::npos);
  for (const char* text : {"title", "x [m]", "y [m]", "here", "first", "second"}) {
    EXPECT_NE(svg.find(std::string(">") + text + "<"), std::string::npos) << text;
  }
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_EQ(svg.find("inf"), std::string::npos);
}

TEST(SvgPlot, APanelWithOnePointOrAFlatLineHasARange) {
  PlotPanel point;
  point.marks = {{{3.0, 0.0}}};
  PlotPanel flat;
  flat.lines = {{{{0.0, 5.0}, {1.0, 5.0}}}};
  const std::string svg = svg_of("", {point, flat}, 1);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_EQ(svg.find("inf"), std::string::npos);
}

/// Coordinates of the first circle, in pixels.
Eigen::Vector2d first_circle(const std::string& svg) {
  tinyxml2::XMLDocument document;
  EXPECT_EQ(document.Parse(svg.c_str()), tinyxml2::XML_SUCCESS);
  const tinyxml2::XMLElement* circle =
      document.RootElement()->FirstChildElement("g")->FirstChildElement("circle");
  return {circle->DoubleAttribute("cx"), circle->DoubleAttribute("cy")};
}

TEST(SvgPlot, ALogarithmicAxisPutsTheGeometricMeanInTheMiddle) {
  PlotPanel panel;
  panel.x_scale = Scale::kLog;
  panel.lines = {{{{0.01, 0.0}, {100.0, 2.0}}}};
  panel.marks = {{{1.0, 1.0}}};
  const std::string log = svg_of("", {panel}, 1);
  panel.x_scale = Scale::kLinear;
  panel.marks = {{{50.005, 1.0}}};
  const std::string linear = svg_of("", {panel}, 1);
  EXPECT_NEAR((first_circle(log) - first_circle(linear)).norm(), 0.0, 0.02);
  for (const char* tick : {"0.01", "0.1", "1", "10", "100"}) {
    EXPECT_NE(log.find(std::string(">") + tick + "<"), std::string::npos) << tick;
  }
}

TEST(SvgPlot, WhatLiesOutsideAFixedRangeIsCutOff) {
  PlotPanel panel;
  panel.marks = {{{1.0, 1.0}}, {{100.0, 100.0}}};
  EXPECT_EQ(svg_of("", {panel}, 1).find("clipPath"), std::string::npos);
  panel.range = Eigen::AlignedBox2d(Eigen::Vector2d(0.0, 0.0), Eigen::Vector2d(2.0, 2.0));
  const std::string svg = svg_of("", {panel, panel}, 2);
  for (const char* name : {"axes0", "axes1"}) {  // each panel cuts by its own axes
    EXPECT_NE(svg.find(std::string("<clipPath id=\"") + name), std::string::npos);
    EXPECT_NE(svg.find(std::string("clip-path=\"url(#") + name), std::string::npos);
  }
  EXPECT_NE(svg.find(">1.5<"), std::string::npos);
  EXPECT_EQ(svg.find(">100<"), std::string::npos);
}

TEST(SvgPlot, TheLegendStandsWhereItHidesLeast) {
  for (const auto& [corner, hidden] : {std::pair{Corner::kTopRight, Eigen::Vector2d(-1.0, -1.0)},
                                       std::pair{Corner::kBottomLeft, Eigen::Vector2d(1.0, 1.0)}}) {
    // Three corners are full; the fourth, opposite to `hidden`, is empty.
    PlotPanel panel;
    panel.range = Eigen::AlignedBox2d(Eigen::Vector2d(-1.1, -1.1), Eigen::Vector2d(1.1, 1.1));
    for (const double x : {-1.0, 1.0}) {
      for (const double y : {-1.0, 1.0}) {
        if (Eigen::Vector2d(x, y) != -hidden) panel.marks.push_back({{0.95 * x, 0.9 * y}});
      }
    }
    panel.legend = {{"one"}, {"two"}};
    panel.legend_corner = corner;
    const std::string chosen = svg_of("", {panel}, 1);
    panel.legend_corner = Corner::kEmptiest;
    EXPECT_EQ(svg_of("", {panel}, 1), chosen);
  }
}

TEST(SvgPlot, TheLegendOfAllPanelsGetsRowsAsItNeeds) {
  const PlotPanel panel;
  const std::vector<PlotLegend> few{{"one"}, {"two"}};
  const std::vector<PlotLegend> many(20, PlotLegend{"an entry"});
  const auto height = [&](const std::vector<PlotLegend>& legend) {
    tinyxml2::XMLDocument document;
    EXPECT_EQ(document.Parse(svg_of("", {panel}, 1, {}, legend).c_str()), tinyxml2::XML_SUCCESS);
    return document.RootElement()->DoubleAttribute("height");
  };
  EXPECT_LT(height({}), height(few));
  EXPECT_LT(height(few), height(many));
}

}  // namespace
}  // namespace hlc::plot
