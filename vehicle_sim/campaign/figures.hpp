#pragma once

#include <optional>
#include <span>
#include <string>

#include "planner/road/lanelet_map.hpp"
#include "vehicle_sim/campaign/campaign.hpp"

/// Figures of runs, as SVG. All runs of a figure are of one scenario and profile and differ in
/// their subgraph or policy, for which "subgraph" stands here too; "the first vehicle" is the one
/// of highest priority, as in the paper.
namespace hlc::campaign {

/// The paper's Fig. 4: driven paths of the first vehicle, one line per subgraph, with its lane's
/// centre; beside it, enlarged, the place of their largest difference, measured at equal arc
/// lengths of the first lap.
/// @param map  absent: open ground
/// @pre at least one run; so below
[[nodiscard]] std::string paths_figure(std::span<const DrivenRun> runs,
                                       const std::optional<road::LaneletMap>& map);

/// Distance of the first vehicle's planned positions to its lane's centre (the table's reference
/// error) over arc length from the start.
[[nodiscard]] std::string error_figure(std::span<const DrivenRun> runs);

/// Generated and expanded vertices of every vehicle's search over time, one panel per subgraph, on
/// a logarithmic scale. Steps in which a vehicle did not search are gaps.
[[nodiscard]] std::string vertices_figure(std::span<const DrivenRun> runs);

/// Planning times of all vehicles on a logarithmic scale: their distribution, and the share that
/// took at least as long. Planning times of 0 are left out.
[[nodiscard]] std::string planning_time_figure(std::span<const DrivenRun> runs);

/// Distance of the driven footprints, pair by pair, over time, one panel per subgraph, with
/// contact and the distance that plans keep (both vehicles' margins). Distances beyond 0.6 m are
/// cut off.
/// @pre at least two vehicles
[[nodiscard]] std::string distance_figure(std::span<const DrivenRun> runs);

/// The subgraph of every vehicle's plans over time as a coloured band below the vehicle's true
/// speed; the time that the vehicle is in a zone of the run's policy is shaded, with the zone's
/// limit. One panel per vehicle, of the runs with policies; if there are none, of all. Up to ten
/// subgraphs have different colours.
[[nodiscard]] std::string subgraphs_figure(std::span<const DrivenRun> runs);

}  // namespace hlc::campaign
