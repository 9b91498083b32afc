#pragma once

#include <cstdint>
#include <span>

#include "planner/automaton/subgraph.hpp"
#include "planner/controller/controller_options.hpp"
#include "planner/road/placement.hpp"

/// Digests of what planning for a vehicle depends on and what does not change from step to step.
/// Controllers compare them to find out whether they can plan for each other; they are not a proof
/// that the plans agree, which only the digests of the plans are.
namespace hlc::controller {

/// Of the automaton (motions, areas, criteria) and of the enabled part of it.
[[nodiscard]] std::uint64_t digest_of(const automaton::Subgraph& subgraph);
/// Of the permitted routes: paths, bounds, driving lines, speed sections.
[[nodiscard]] std::uint64_t digest_of(std::span<const road::DrivableRoute> routes);
/// Of the rules by which a controller plans and coordinates, without its vehicle. A user's own
/// function counts as any other one of its kind.
[[nodiscard]] std::uint64_t digest_of(const ControllerOptions& options);
/// Of areas in their order.
[[nodiscard]] std::uint64_t digest_of(std::span<const ConvexPolygon> areas_m);

}  // namespace hlc::controller
