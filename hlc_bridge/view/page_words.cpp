#include "hlc_bridge/view/page_words.hpp"

#include "planner/coordination/report.hpp"

namespace hlc::view {
namespace {

using coordination::FallbackReason;
using coordination::PlanQuality;

/// Why a vehicle kept its plan: because of CARS, and where none are named.
std::pair<const char*, const char*> words_of(FallbackReason reason) {
  switch (reason) {
    case FallbackReason::kNone:
      break;
    case FallbackReason::kInfeasible:
      return {"no other plan is possible, because of CARS", "no other plan is possible"};
    case FallbackReason::kBudget:
      return {"the search stopped at its budget before it found one, because of CARS",
              "the search stopped at its budget before it found one"};
    case FallbackReason::kMissing:
      return {"no message from or to CARS", "no message was received"};
    case FallbackReason::kConflict:
      return {"conflict with CARS", "conflict with another car"};
    case FallbackReason::kNeighbour:
      return {"CARS, planned with it, fell back", "another car, planned with it, fell back"};
    case FallbackReason::kDeviation:
      return {"it is too far off the plan, or not seen", "it is too far off the plan, or not seen"};
    case FallbackReason::kLate:
      return {"a deadline of the step had passed", "a deadline of the step had passed"};
    case FallbackReason::kUndrivable:
      return {"the new one is beyond what it can follow",
              "the new one is beyond what it can follow"};
    case FallbackReason::kOffRoute:
      return {"it cannot get onto its route from here", "it cannot get onto its route from here"};
  }
  return {"no reason", "no reason"};
}

const char* words_of(PlanQuality quality) {
  switch (quality) {
    case PlanQuality::kNone:
      return "no plan was found";
    case PlanQuality::kOptimal:
      return "optimal";
    case PlanQuality::kBudget:
      return "the search stopped early";
    case PlanQuality::kUnproven:
      return "not proven optimal";
  }
  return "unknown";
}

/// From the enumerator 0 to `last`, by name.
template <class Enum>
Json words_up_to(Enum last) {
  Json words;
  for (int i = 0; i <= static_cast<int>(last); ++i) {
    const auto one = static_cast<Enum>(i);
    words[to_string(one)] = words_of(one);
  }
  return words;
}

}  // namespace

Json page_words() {
  return {
      {"keys",
       "Space: play; J: backwards; left, right: one step (with Shift: ten); Home, End; N, P: next, "
       "previous car; Escape: no car; F: follow; +, -, 0: zoom. Map: drag to move, wheel or two "
       "fingers to zoom, click a car for its report. The address of the page leads to the moment "
       "shown."},
      {"terms",
       {{"state", "waits: without the others it would drive; stuck: it waits for long"},
        {"status", "planned: a new plan; fallback: the former plan stays in force, and why"},
        {"coupled with", "cars that may come close soon: they plan one after the other"},
        {"maneuver",
         "driven in this step; named after its criterion, or trim: constant speed and steering"},
        {"why", "what explain found for this step, or for the one in which it began"},
        {"searched", "the plans that were looked at, and what ruled them out"},
        {"subgraph", "the trims and maneuvers that it may use"},
        {"plan", "maneuvers from this step on, until it stands"},
        {"zones held", "where routes cross or merge: a car holds parts of them"},
        {"difference", "between the driven and the planned pose"},
        {"deviation", "how far the car sticks out of its footprint at the planned pose"},
        {"level", "0 plans first, the others wait for the plans of lower levels"}}},
      {"kinds",
       {{"drives", "drives"},
        {"stands", "stands"},
        {"waits", "waits for others"},
        {"stuck", "stuck: waits for long"},
        {"fallback", "keeps its old plan (fallback)"},
        {"stop", "minimal-risk stop"},
        {"standby", "standby"},
        {"unknown", "no driven path recorded"},
        {"silent", "no report"},
        {"late", "deadline missed (lowest strip)"}}},
      {"qualities", words_up_to(PlanQuality::kUnproven)},
      {"reasons", words_up_to(FallbackReason::kOffRoute)}};
}

}  // namespace hlc::view
