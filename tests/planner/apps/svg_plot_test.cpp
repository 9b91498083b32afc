#include "planner/apps/svg_plot.hpp"

#include <gtest/gtest.h>
#include <tinyxml2.h>

#include <cmath>
#include <random>

namespace hlc {
namespace {

using testing::Message;

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

TEST(SvgPlot, TicksAreRoundAndCoverTheRange) {
  constexpr unsigned kSeed = 5;
  std::mt19937 random(kSeed);
  std::uniform_real_distribution<double> exponent(-6.0, 6.0);
  std::uniform_real_distribution<double> middle(-3.0, 3.0);
  for (int run = 0; run < 500; ++run) {
    SCOPED_TRACE(Message() << "seed " << kSeed << ", run " << run);
    const double width = std::pow(10.0, exponent(random));
    const double min = middle(random) * width;
    const std::vector<double> ticks = nice_ticks(min, min + width);
    ASSERT_GE(ticks.size(), 2U);
    ASSERT_LE(ticks.size(), 8U);
    const double step = ticks[1] - ticks[0];
    const double leading = step / std::pow(10.0, std::floor(std::log10(step) + 1e-9));
    EXPECT_TRUE(std::abs(leading - 1.0) < 1e-6 || std::abs(leading - 2.0) < 1e-6 ||
                std::abs(leading - 5.0) < 1e-6)
        << step;
    EXPECT_LT(ticks.front() - min, step * (1.0 + 1e-6));
    EXPECT_LT(min + width - ticks.back(), step * (1.0 + 1e-6));
    for (const double tick : ticks) {
      EXPECT_NEAR(tick / step, std::round(tick / step), 1e-6);
    }
  }
  EXPECT_EQ(nice_ticks(0.0, 1.0),
            (std::vector<double>{0.0, 0.2, 0.4, 0.6000000000000001, 0.8, 1.0}));
}

TEST(SvgPlot, ColoursRunFromRedToBlue) {
  EXPECT_EQ(red_to_blue(0.0), "#d61e23");
  EXPECT_EQ(red_to_blue(1.0), "#1446d7");
  EXPECT_EQ(red_to_blue(-3.0), red_to_blue(0.0));
}

}  // namespace
}  // namespace hlc
