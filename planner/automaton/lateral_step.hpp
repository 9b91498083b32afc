#pragma once

#include "planner/automaton/subgraph.hpp"

namespace hlc::automaton {

/// How far beside a line a vehicle may get since it has some steerings only [m], at least 0:
///
///     max over neighbouring steerings a, b of  | kappa_b - kappa_a | / 4 (v step_s)^2
///
/// with v the lesser one of the least driving speeds of its trims with these steerings. A line
/// whose curvature lies midway between both differs from either by half the difference, kappa', and
/// driving on for a step leads 1/2 kappa' (v step_s)^2 away from it. With one steering it is 0. The
/// paper's subgraphs B and D have 5.1 and 6.0 mm, 49 trims that drive slowly 0.3 mm.
[[nodiscard]] double lateral_step_m(const Subgraph& subgraph);

}  // namespace hlc::automaton
