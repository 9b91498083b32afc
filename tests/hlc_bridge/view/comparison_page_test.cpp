#include "hlc_bridge/view/comparison_page.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <set>

#include "hlc_bridge/view/page_files.hpp"
#include "tests/hlc_bridge/view/sample_run.hpp"

namespace hlc::view {
namespace {

using testing::HasSubstr;
using testing::Not;

result::ComparedRun compared(FinishedRun run, const std::string& name) {
  return {.name = name,
          .summary = result::summarize(run.description, run.facts, run.rows, run.drives),
          .facts = run.facts,
          .rows = std::move(run.rows),
          .drives = std::move(run.drives),
          .incomplete = {}};
}

/// The settings of custom properties with this begin: "--car-0: #d55e00;", ...
std::set<std::string> settings(const std::string& text, const std::string& begin) {
  std::set<std::string> found;
  for (std::size_t at = text.find(begin); at != std::string::npos; at = text.find(begin, at + 1)) {
    const std::string one = text.substr(at, text.find_first_of(";)", at) - at + 1);
    if (one.ends_with(';')) found.insert(one);  // no use: var(--car-0)
  }
  return found;
}

std::size_t occurrences(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
    ++found;
  }
  return found;
}

/// Of two runs that differ in step 3 of the second car, if `different`.
result::RunComparison comparison_of(std::uint8_t cars, bool different,
                                    const std::string& name = "red") {
  FinishedRun other = sample_run(cars, 10, name);
  if (different) other.rows.at(3U * cars + 1U).record.report.level = 7;
  return result::compare(compared(sample_run(cars, 10, name), "runs/one"),
                         compared(std::move(other), "runs/two"), {"seed: 1 and 2"});
}

std::string page_of(const result::RunComparison& comparison) {
  const auto map = sample_run(2, 1).map;
  return comparison_page(comparison, map, map);
}

TEST(ComparisonPage, HasTheLinesAndTheTables) {
  const std::string page = page_of(comparison_of(2, true));
  EXPECT_THAT(page, HasSubstr("<p>first run: runs/one (sample, "));
  EXPECT_THAT(page, HasSubstr("<p>started differently: seed: 1 and 2</p>"));
  EXPECT_THAT(page, HasSubstr("<p class=\"result\">the runs differ at step 3 (0.6 s), vehicle 2: "
                              "messages: computation level 0 and 7</p>"));
  EXPECT_THAT(page, HasSubstr("<td>1 red</td><td>both</td>"));
  EXPECT_THAT(page, HasSubstr("<td>collisions</td>"));
}

TEST(ComparisonPage, DrawsLanesAndAPathPerCarAndRun) {
  const std::string page = page_of(comparison_of(2, true));
  EXPECT_EQ(occurrences(page, "<path class=\"lane\""), 2U);
  EXPECT_EQ(occurrences(page, "<path class=\"other\""), 0U);
  EXPECT_EQ(occurrences(page, "<path class=\"a\" style=\"stroke:var(--car-"), 2U);
  EXPECT_EQ(occurrences(page, "<path class=\"b\" style=\"stroke:var(--car-"), 2U);
  EXPECT_EQ(occurrences(page, "<circle class=\"mark\""), 3U) << "both runs and the legend";
  EXPECT_THAT(page, HasSubstr("first difference, vehicle 2, step 3</span>"));
}

TEST(ComparisonPage, OfEqualRunsHasNoMark) {
  const std::string page = page_of(comparison_of(2, false));
  EXPECT_THAT(page, HasSubstr("the runs are equal: 10 steps, 2 vehicles, trace_sha256 "));
  EXPECT_EQ(occurrences(page, "<circle"), 0U);
}

TEST(ComparisonPage, DrawsTheOtherMapOnlyIfItDiffers) {
  const auto map_a = sample_run(2, 1).map;
  const auto map_b = sample_run(3, 1).map;
  const result::RunComparison comparison = comparison_of(2, false);
  EXPECT_EQ(occurrences(comparison_page(comparison, map_a, map_b), "<path class=\"other\""), 3U);
  EXPECT_EQ(
      occurrences(comparison_page(comparison, std::nullopt, std::nullopt), "<path class=\"lane\""),
      0U);
}

TEST(ComparisonPage, NamesAreText) {
  result::RunComparison comparison = comparison_of(2, true, "</p><script>alert(1)</script>\"&");
  comparison.a.name = "<b>";
  comparison.first->text = "plan: <i>";
  const std::string page = page_of(comparison);
  EXPECT_THAT(page, Not(HasSubstr("<script")));
  EXPECT_THAT(page, Not(HasSubstr("<b>")));
  EXPECT_THAT(page, Not(HasSubstr("<i>")));
  EXPECT_THAT(page, HasSubstr("&lt;script&gt;alert(1)&lt;/script&gt;&quot;&amp;"));
}

TEST(ComparisonPage, LoadsNothing) {
  const std::string page = page_of(comparison_of(2, true));
  EXPECT_THAT(page, HasSubstr("default-src 'none'"));
  EXPECT_THAT(page, Not(HasSubstr(" src=")));
  EXPECT_THAT(page, Not(HasSubstr("http:")));
  EXPECT_THAT(page, Not(HasSubstr("https:")));
  EXPECT_EQ(occurrences(page, "href="), 1U) << "the empty icon";
}

TEST(ComparisonPage, WhatIsNoPlaceIsLeftOut) {
  result::RunComparison comparison = comparison_of(2, true);
  for (auto& [id, drive] : comparison.a.drives) {
    drive.at(2).pose.x_m = std::numeric_limits<double>::quiet_NaN();
    drive.at(3).pose.y_m = std::numeric_limits<double>::infinity();
  }
  comparison.b.drives.clear();
  const std::string page = page_of(comparison);
  EXPECT_THAT(page, Not(HasSubstr("nan,")));
  EXPECT_THAT(page, Not(HasSubstr("inf")));
  EXPECT_EQ(occurrences(page, "<path class=\"b\" style=\"stroke:var(--car-"), 0U);
}

TEST(ComparisonPage, RunsWithoutDrivesHaveAPage) {
  FinishedRun run = sample_run(2, 1);
  run.drives.clear();
  const result::RunComparison comparison =
      result::compare(compared(run, "one"), compared(run, "two"), {});
  EXPECT_THAT(comparison_page(comparison, std::nullopt, std::nullopt),
              HasSubstr("No lanes and no driven path"));
}

TEST(ComparisonPage, HasTheColoursOfThePageOfARun) {
  const std::string page = comparison_page(comparison_of(3, true), {}, {});
  const std::string& css = page_files().at("page.css");
  for (const char* begin : {"--car-", "--lane", "--bound", "--alarm", "--muted"}) {
    EXPECT_EQ(settings(page, begin), settings(css, begin));
    EXPECT_FALSE(settings(page, begin).empty());
  }
}

}  // namespace
}  // namespace hlc::view
