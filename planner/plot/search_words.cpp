#include "planner/plot/search_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "planner/automaton/trim_format.hpp"
#include "planner/search/search_options.hpp"

namespace hlc::plot {
namespace {

using search::Alternative;
using search::Fate;
using search::NoPath;
using search::RecordedSearch;
using search::SearchStatus;

std::string count_text(double count) {
  constexpr double kMostDigits = 1e7;
  return count < kMostDigits ? fmt::format("{:.0f}", count) : fmt::format("{:.3g}", count);
}

std::string without_plan(const scenario::ProblemFile& file, const RecordedSearch& recorded,
                         const search::PlanCounts& counts) {
  if (recorded.result.reason == NoPath::kBudget) {
    return fmt::format("The search stopped early, after {} expansions, without a plan.",
                       recorded.result.expanded);
  }
  if (counts.total == 0.0) {
    return fmt::format(
        "There is no plan: from trim {} no sequence of {} maneuvers may end in "
        "standstill.",
        file.problem.start_trim, file.problem.horizon_steps());
  }
  return "There is no plan: every one meets an obstacle or the boundary.";
}

std::string plan_line(const scenario::ProblemFile& file, const search::SearchResult& plan) {
  std::string line = fmt::format("The plan found begins with {} and costs {} m²: ",
                                 name_of(*plan.maneuvers.front()), cost_text(plan.cost));
  line += plan.status == SearchStatus::kOptimal
              ? "no plan costs less."
              : fmt::format(
                    "the search stopped early, after {} expansions; a plan that costs up to "
                    "{} m² less may exist.",
                    plan.expanded, cost_text(plan.cost - plan.lower_bound));
  if (plan.maneuvers == file.problem.incumbent) {
    line += " It is the rest of the plan in force (incumbent).";
  }
  return line;
}

std::string runner_up_line(const RecordedSearch& recorded) {
  const Alternative* const second = runner_up(recorded.alternatives);
  const bool is_exact = std::ranges::none_of(recorded.alternatives, [](const Alternative& one) {
    return one.best.status == SearchStatus::kBudget || one.best.reason == NoPath::kBudget;
  });
  const std::string caveat =
      is_exact ? "" : " A search for these stopped early: a better one may exist.";
  if (second == nullptr) {
    return "Runner-up: none, no plan was found with another first maneuver." + caveat;
  }
  const double extra_m2 = second->best.cost - recorded.result.cost;
  return fmt::format(
      "Runner-up: the best plan with another first maneuver begins with {} and costs {} m², "
      "{:.4g} m² {}.{}",
      name_of(*second->first), cost_text(second->best.cost), std::abs(extra_m2),
      extra_m2 < 0.0 ? "less" : "more", caveat);
}

std::string counts_line(const search::PlanCounts& counts) {
  const auto of = [&counts](Fate fate) {
    const double count = counts.fates[static_cast<std::size_t>(fate)];
    return fmt::format("{} ({:.3g} %)", count_text(count), 100.0 * count / counts.total);
  };
  std::string line = fmt::format(
      "Of {} sequences of maneuvers that end in standstill, {} were ruled out by a collision, {} "
      "by "
      "their bound",
      count_text(counts.total), of(Fate::kCollision), of(Fate::kBound));
  if (counts.fates[static_cast<std::size_t>(Fate::kOpen)] > 0.0) {
    line += fmt::format(", {} were still open", of(Fate::kOpen));
  }
  return line + ".";
}

}  // namespace

std::string cost_text(double cost_m2) { return fmt::format("{:.6g}", cost_m2); }

std::string name_of(const automaton::Maneuver& maneuver) {
  return maneuver.is_self_loop() ? fmt::format("trim {} kept", maneuver.to)
                                 : fmt::format("{} to trim {}", maneuver.label, maneuver.to);
}

std::string problem_line(const scenario::ProblemFile& file) {
  return fmt::format(
      "Subgraph {}, {} steps of {:.3g} s, start in trim {}. Engine best_first, cost-to-go {}, at "
      "most {} expansions.",
      file.subgraph->spec().name, file.problem.horizon_steps(), file.subgraph->automaton().step_s,
      file.problem.start_trim, search::to_string(file.search.cost_to_go),
      file.search.max_expansions);
}

std::vector<std::string> search_lines(const scenario::ProblemFile& file,
                                      const RecordedSearch& recorded) {
  const search::PlanCounts counts = count_plans(recorded.tree, *file.subgraph, file.problem);
  std::vector<std::string> lines;
  if (recorded.result.maneuvers.empty()) {
    lines.push_back(without_plan(file, recorded, counts));
  } else {
    lines.push_back(plan_line(file, recorded.result));
    lines.push_back(runner_up_line(recorded));
  }
  if (counts.total > 0.0) lines.push_back(counts_line(counts));
  return lines;
}

std::string outcome_of(const Alternative& alternative, const search::HorizonProblem& problem,
                       const OccupiedAreas& occupied) {
  if (alternative.obstruction) {
    return "meets " + occupied.name_of(*alternative.obstruction, 1, problem);
  }
  switch (alternative.best.status) {
    case SearchStatus::kOptimal:
      return "free";
    case SearchStatus::kBudget:
      return "free; the search behind it stopped early: a better plan may exist";
    default:
      return alternative.best.reason == NoPath::kBudget
                 ? "free; the search behind it stopped early, without a plan"
                 : "free, but no plan behind it";
  }
}

}  // namespace hlc::plot
