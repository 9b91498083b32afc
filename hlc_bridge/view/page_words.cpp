#include "hlc_bridge/view/page_words.hpp"

namespace hlc::view {

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
        {"zones held", "numbers of the zones, where routes cross or merge, that it holds parts of"},
        {"difference", "between the driven and the planned pose"},
        {"deviation", "how far the car sticks out of its footprint at the planned pose"},
        {"level", "0 plans first, the others wait for the plans of lower levels"}}},
      {"qualities",
       {{"none", "no plan was found"},
        {"optimal", "optimal"},
        {"budget", "the search stopped early"},
        {"unproven", "not proven optimal"}}},
      {"reasons",
       {{"none", "none"},
        {"infeasible", "no other plan is possible, because of CARS"},
        {"infeasible alone", "no other plan is possible"},
        {"budget", "the search stopped at its budget before it found one"},
        {"missing", "no message from or to CARS"},
        {"conflict", "conflict with CARS"},
        {"conflict alone", "conflict with another car"},
        {"neighbour", "CARS, planned with it, fell back"},
        {"neighbour alone", "another car, planned with it, fell back"},
        {"deviation", "it is too far off the plan, or not seen"},
        {"late", "a deadline of the step had passed"},
        {"undrivable", "the new one is beyond what it can follow"},
        {"off_route", "it cannot get onto its route from here"}}}};
}

}  // namespace hlc::view
