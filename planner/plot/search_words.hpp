#pragma once

#include <array>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "planner/plot/occupied_areas.hpp"
#include "planner/scenario/problem_file.hpp"
#include "planner/search/recorded_search.hpp"

/// A recorded search in words, without markup.
namespace hlc::plot {

[[nodiscard]] std::string cost_text(double cost_m2);

/// "J2 to trim 3".
[[nodiscard]] std::string name_of(const automaton::Maneuver& maneuver);

/// Horizon, start and options of the search.
[[nodiscard]] std::string problem_line(const scenario::ProblemFile& file);

/// The decision, a sentence each: the plan, the runner-up, and how many plans were ruled out by
/// what.
[[nodiscard]] std::vector<std::string> search_lines(const scenario::ProblemFile& file,
                                                    const search::RecordedSearch& recorded);

/// What became of a first maneuver.
[[nodiscard]] std::string outcome_of(const search::Alternative& alternative,
                                     const search::HorizonProblem& problem,
                                     const OccupiedAreas& occupied);

/// Terms and their meaning for a reader who sees a search for the first time.
inline constexpr std::array<std::pair<std::string_view, std::string_view>, 13> kSearchTerms{{
    {"trim", "a motion that can be kept: constant speed and steering; numbered from 1"},
    {"maneuver",
     "a precomputed motion of one step from one trim to another, or a trim kept for a "
     "step; J1, J2, ...: the criterion that it is optimal for"},
    {"plan", "a sequence of maneuvers, one per step, that ends in standstill"},
    {"cost",
     "sum of the squared distances between positions and reference points after each step "
     "(and of weights of the maneuvers, if the problem has them): the least cost wins"},
    {"vertex", "begin of a plan: the maneuvers up to some step, its depth"},
    {"f = g + h",
     "g: cost up to the vertex; h: lower bound on the cost of the rest. No plan through "
     "the vertex costs less than f"},
    {"open list", "the vertices generated and not yet looked at; that of least f is taken first"},
    {"expanded",
     "taken from the open list, and every maneuver that "
     "may follow gives a new vertex"},
    {"collision", "the vertex was taken, but its last maneuver meets an obstacle or the boundary"},
    {"bound", "never taken: its f is no less than the cost of the plan found"},
    {"open", "never taken: the search stopped early"},
    {"goal", "taken, free and complete: the plan that ended the search"},
    {"runner-up",
     "the best plan with another first maneuver, found by a search of its own; only "
     "the first maneuver is driven before the next plan is made"},
}};

}  // namespace hlc::plot
