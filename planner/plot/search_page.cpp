#include "planner/plot/search_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>
#include <vector>

#include "planner/automaton/trim_format.hpp"
#include "planner/plot/occupied_areas.hpp"
#include "planner/plot/search_page_style.hpp"
#include "planner/plot/search_pictures.hpp"
#include "planner/plot/search_words.hpp"
#include "planner/plot/svg_elements.hpp"

namespace hlc::plot {
namespace {

using search::Alternative;
using search::Fate;
using search::RecordedSearch;
using svg::escaped;
using Row = std::vector<std::string>;

std::string table(const Row& heading, const std::vector<Row>& rows, bool ends_with_words) {
  const auto line = [&](const char* cell, const Row& row) {
    std::string html = "<tr>";
    for (std::size_t i = 0; i < row.size(); ++i) {
      const bool is_text = ends_with_words && i + 1 == row.size();
      html += fmt::format("<{0}{1}>{2}</{0}>", cell, is_text ? " class=\"words\"" : "",
                          escaped(row[i]));
    }
    return html + "</tr>\n";
  };
  std::string html = "<div class=\"scroll\"><table>\n" + line("th", heading);
  for (const Row& row : rows) html += line("td", row);
  return html + "</table></div>\n";
}

std::string first_maneuvers(const scenario::ProblemFile& file, const RecordedSearch& recorded,
                            const OccupiedAreas& occupied) {
  const search::SearchResult& plan = recorded.result;
  const Alternative* const second = runner_up(recorded.alternatives);
  std::vector<Row> rows;
  if (!plan.maneuvers.empty()) {
    rows.push_back({name_of(*plan.maneuvers.front()), cost_text(plan.cost), "", "the plan found"});
  }
  std::vector<const Alternative*> sorted;
  for (const Alternative& one : recorded.alternatives) sorted.push_back(&one);
  std::ranges::stable_sort(sorted, {}, [](const Alternative* one) {
    const bool has_plan = !one->best.maneuvers.empty();
    return std::pair(!has_plan, has_plan ? one->best.cost : 0.0);
  });
  for (const Alternative* one : sorted) {
    const bool has_plan = !one->best.maneuvers.empty();
    const bool has_both = has_plan && !plan.maneuvers.empty();
    rows.push_back(
        {name_of(*one->first), has_plan ? cost_text(one->best.cost) : "",
         has_both ? fmt::format("{:+.4g}", one->best.cost - plan.cost) : "",
         outcome_of(*one, file.problem, occupied) + (one == second ? "; runner-up" : "")});
  }
  return "<h2>What the plan could have begun with</h2>\n"
         "<p class=\"note\">Each maneuver that can be driven in the first step, with the best plan "
         "that begins with it. Areas are numbered as on the map below.</p>\n" +
         table({"first maneuver", "cost [m²]", "more [m²]", "what became of it"}, rows, true);
}

std::string depth_table(const RecordedSearch& recorded) {
  const std::vector<search::DepthCounts> depths = counts_by_depth(recorded.tree);
  constexpr std::array kFatesShown{Fate::kExpanded, Fate::kCollision, Fate::kBound, Fate::kOpen,
                                   Fate::kGoal};
  const auto of = [](const search::DepthCounts& depth, Fate fate) {
    return depth.fates[static_cast<std::size_t>(fate)];
  };
  std::vector<Row> rows;
  search::DepthCounts sum;
  for (std::size_t d = 0; d < depths.size(); ++d) {
    Row row{fmt::to_string(d), fmt::to_string(depths[d].generated)};
    for (const Fate fate : kFatesShown) row.push_back(fmt::to_string(of(depths[d], fate)));
    const double least_m2 = depths[d].least_estimate_m2;
    row.push_back(std::isfinite(least_m2) ? cost_text(least_m2) : "none");
    rows.push_back(std::move(row));
    sum.generated += depths[d].generated;
    for (std::size_t i = 0; i < search::kFates; ++i) sum.fates[i] += depths[d].fates[i];
  }
  Row total{"all", fmt::to_string(sum.generated)};
  for (const Fate fate : kFatesShown) total.push_back(fmt::to_string(of(sum, fate)));
  total.emplace_back();
  rows.push_back(std::move(total));
  return "<h2>Vertices by depth</h2>\n" + table({"depth", "generated", "expanded", "collision",
                                                 "bound", "open", "goal", "least f [m²]"},
                                                rows, false);
}

std::string obstacle_table(const search::HorizonProblem& problem, const OccupiedAreas& occupied) {
  std::vector<Row> rows;
  for (std::size_t i = 0; i < occupied.areas.size(); ++i) {
    const OccupiedArea& area = occupied.areas[i];
    if (area.dropped == 0) continue;
    rows.push_back(
        {fmt::format("area {}", i + 1), ranges_of(area.steps), fmt::to_string(area.dropped)});
  }
  const std::size_t others = occupied.areas.size() - rows.size();
  if (!problem.boundary_m.empty()) {
    rows.push_back({"boundary", "all", fmt::to_string(occupied.dropped_by_boundary)});
  }
  std::string html = "<h2>What was in the way</h2>\n";
  if (occupied.areas.empty() && rows.empty()) {
    return html + "<p>The problem has neither obstacles nor a boundary.</p>\n";
  }
  html +=
      "<p class=\"note\">An area is what another vehicle may occupy in a step, the end of the "
      "right of way, or an obstacle. A vertex that meets several counts for the first. "
      "Vertices that were never taken from the open list were not checked.</p>\n";
  if (!rows.empty()) html += table({"what", "in steps", "vertices dropped"}, rows, false);
  if (others > 0) html += fmt::format("<p>{} more areas ruled out no vertex.</p>\n", others);
  return html;
}

/// Explains the marks that the pictures have.
std::string legend(const RecordedSearch& recorded) {
  std::string html = "<p class=\"legend note\">\n";
  const auto add = [&html](bool is_drawn, std::string_view shape, std::string_view text) {
    if (!is_drawn) return;
    html += fmt::format("<span><svg viewBox=\"0 0 34 14\" aria-hidden=\"true\">{}</svg>{}</span>\n",
                        shape, text);
  };
  const auto has = [&recorded](Fate fate) {
    return std::ranges::find(recorded.tree.vertices, fate, &search::TreeVertex::fate) !=
           recorded.tree.vertices.end();
  };
  const bool has_plan = !recorded.result.maneuvers.empty();
  add(has_plan, R"(<path class="winner" d="M1,7H33"/>)", "the plan found");
  add(has_plan && runner_up(recorded.alternatives) != nullptr,
      R"(<path class="second" d="M1,7H33"/>)", "runner-up");
  add(has(Fate::kExpanded), R"(<path class="vertex expanded" d="M17,7h0"/>)", "expanded");
  add(has(Fate::kCollision), R"(<path class="vertex collision" d="M14,4l6,6m0,-6l-6,6"/>)",
      "collision");
  add(has(Fate::kBound), R"(<path class="vertex bound" d="M17,7h0"/>)", "ruled out by its bound");
  add(has(Fate::kOpen), R"(<path class="vertex open" d="M17,7h0"/>)", "open");
  const std::size_t all = recorded.tree.vertices.size();
  if (all > kMostDrawn) {
    html += fmt::format("Drawn are {} of {} vertices: those taken from the open list first.",
                        kMostDrawn, all);
  }
  return html + "</p>\n";
}

}  // namespace

std::string search_page(const scenario::ProblemFile& file, const RecordedSearch& recorded) {
  const OccupiedAreas occupied = occupied_areas(file.problem, recorded.tree);
  std::string html{kSearchPageHead};
  html += "<h1>What was searched for one plan</h1>\n";
  html += "<p class=\"note\">" + escaped(problem_line(file)) + "</p>\n";
  bool is_first = true;
  for (const std::string& line : search_lines(file, recorded)) {
    html += fmt::format("<p{}>{}</p>\n", is_first ? " class=\"result\"" : "", escaped(line));
    is_first = false;
  }
  html += first_maneuvers(file, recorded, occupied);
  html +=
      "<h2>The search tree</h2>\n<p class=\"note\">Each mark is a vertex, placed by its depth and "
      "its f; marks at the upper edge lie higher still.";
  if (!recorded.result.maneuvers.empty()) {
    html +=
        " The line across is the cost of the plan found (dashed: of the runner-up). What lies "
        "above "
        "it cannot be better, what lies below it had to be looked at.";
  }
  html += "</p>\n";
  html += tree_picture(recorded) + legend(recorded);
  html +=
      "<h2>The same on the road</h2>\n"
      "<p class=\"note\">Motions are drawn straight from position to position. Rings: the "
      "reference points; thin rectangle: the vehicle; pale: areas of the plan, and numbered "
      "areas that are occupied in the steps named below.</p>\n";
  html += search_map(file, recorded, occupied) + legend(recorded);
  html += depth_table(recorded) + obstacle_table(file.problem, occupied);
  html += "<h2>Terms</h2>\n<dl>\n";
  for (const auto& [term, meaning] : kSearchTerms) {
    html += fmt::format("<dt>{}</dt><dd>{}</dd>\n", term, meaning);
  }
  return html + "</dl>\n</body>\n</html>\n";
}

}  // namespace hlc::plot
