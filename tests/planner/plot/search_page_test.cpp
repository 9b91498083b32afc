#include "planner/plot/search_page.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tinyxml2.h>

#include <algorithm>
#include <memory>
#include <string>

#include "planner/automaton/reachable_sets.hpp"
#include "planner/plot/occupied_areas.hpp"
#include "planner/plot/search_pictures.hpp"
#include "planner/search/recorded_search.hpp"
#include "tests/support/simple_problem.hpp"
#include "tests/support/test_automaton.hpp"

namespace hlc::plot {
namespace {

using testing::HasSubstr;
using testing::Not;

/// Straight on, with names that would be markup.
scenario::ProblemFile make_file(std::size_t horizon_steps) {
  const std::string label = "<i>&\"";
  const auto automaton = test::make_test_automaton(test::paper_trims(), {{label, 0.0}});
  automaton::SubgraphSpec spec{.name = "<script>", .labels = {label}, .trims = {}};
  for (const std::size_t number : test::kAllTrims) spec.trims.push_back({number - 1});
  scenario::ProblemFile file;
  file.subgraph = std::make_shared<automaton::Subgraph>(automaton, spec);
  file.problem = test::straight_problem(horizon_steps);
  return file;
}

search::RecordedSearch record(const scenario::ProblemFile& file) {
  const automaton::ReachableSets reachable(*file.subgraph, file.problem.horizon_steps());
  return search::record_search(*file.subgraph, reachable, file.search, file.problem);
}

std::string page_of(const scenario::ProblemFile& file) { return search_page(file, record(file)); }

/// In front of the car in every step.
void put_obstacle(scenario::ProblemFile& file, double width_m) {
  const ConvexPolygon wall = test::box(1.5, 1.6, 2.0 - width_m, 2.0 + width_m);
  file.problem.obstacles_m.assign(file.problem.horizon_steps(), {wall});
}

TEST(SearchPage, NamesAreTextAndTheWholePageIsWellFormed) {
  scenario::ProblemFile file = make_file(4);
  put_obstacle(file, 0.2);
  std::string page = page_of(file);
  EXPECT_THAT(page, Not(HasSubstr("<script")));
  EXPECT_THAT(page, HasSubstr("Subgraph &lt;script&gt;"));
  EXPECT_THAT(page, HasSubstr("&lt;i&gt;&amp;\" to trim"));
  EXPECT_THAT(page, Not(HasSubstr("://")));
  // As XML, without the elements that HTML does not close.
  page = page.substr(page.find("<body>"));
  page = page.substr(0, page.find("</html>"));
  tinyxml2::XMLDocument document;
  EXPECT_EQ(document.Parse(page.c_str()), tinyxml2::XML_SUCCESS) << document.ErrorStr();
}

TEST(SearchPage, APlanIsComparedWithTheRunnerUp) {
  const std::string page = page_of(make_file(4));
  for (const char* text : {"The plan found begins with", "no plan costs less.",
                           "Runner-up: ", "free; runner-up", "neither obstacles nor a boundary"}) {
    EXPECT_THAT(page, HasSubstr(text));
  }
  EXPECT_THAT(page, Not(HasSubstr("Drawn are")));
}

TEST(SearchPage, WithoutAPlanItNamesWhatEveryFirstManeuverMeets) {
  scenario::ProblemFile file = make_file(4);
  file.problem.obstacles_m.assign(4, {test::box(-9, 9, -9, 9)});
  const std::string page = page_of(file);
  EXPECT_THAT(page, HasSubstr("There is no plan: every one meets an obstacle or the boundary."));
  EXPECT_THAT(page, HasSubstr("meets area 1"));
  EXPECT_THAT(page, HasSubstr("(100 %) were ruled out by a collision"));
  EXPECT_THAT(page, Not(HasSubstr("the plan found</span>")));
}

TEST(SearchPage, ASearchThatStoppedEarlyIsNamedSo) {
  scenario::ProblemFile file = make_file(6);
  put_obstacle(file, 0.2);
  file.search.max_expansions = 2;
  EXPECT_THAT(page_of(file), HasSubstr("stopped early, after 2 expansions, without a plan."));
  EXPECT_THAT(page_of(file), HasSubstr("were still open."));
}

TEST(SearchPage, OfALargeTreeItDrawsAPartAndNamesHowMuch) {
  scenario::ProblemFile file = make_file(8);
  file.problem.obstacles_m.assign(8, {test::box(1.5, 1.6, -5, 5), test::box(0.5, 1.6, 2.4, 2.5)});
  const search::RecordedSearch recorded = record(file);
  const std::size_t all = recorded.tree.vertices.size();
  ASSERT_GT(all, 2 * kMostDrawn);
  const std::string page = search_page(file, recorded);
  EXPECT_THAT(page, HasSubstr("Drawn are 3000 of " + std::to_string(all) + " vertices"));
  EXPECT_THAT(page, HasSubstr("<td>all</td><td>" + std::to_string(all) + "</td>"));
  EXPECT_LT(page.size(), 1'000'000U);
}

TEST(SearchPage, AnAreaThatIsOccupiedInSeveralStepsIsOne) {
  scenario::ProblemFile file = make_file(5);
  put_obstacle(file, 0.2);
  file.problem.obstacles_m[2].push_back(test::box(8, 9, 8, 9));
  file.problem.obstacles_m[3].clear();
  const search::RecordedSearch recorded = record(file);
  const OccupiedAreas occupied = occupied_areas(file.problem, recorded.tree);
  ASSERT_EQ(occupied.areas.size(), 2U);
  EXPECT_EQ(ranges_of(occupied.areas[0].steps), "1-3, 5");
  EXPECT_EQ(ranges_of(occupied.areas[1].steps), "3");
  EXPECT_EQ(occupied.areas[0].dropped,
            static_cast<std::size_t>(std::ranges::count(
                recorded.tree.vertices, search::Fate::kCollision, &search::TreeVertex::fate)));
  EXPECT_EQ(occupied.name_of({.obstacle = 1}, 3, file.problem), "area 2");
  EXPECT_EQ(occupied.name_of({}, 3, file.problem), "the boundary");
}

}  // namespace
}  // namespace hlc::plot
