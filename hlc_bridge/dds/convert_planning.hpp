#pragma once

#include <TrafficMessage.h>

#include "hlc_bridge/dds/conversion.hpp"

/// Parts of our own types. Only sources of this folder include this file.
namespace hlc::dds {

[[nodiscard]] PoseMessage pose_to_wire(const Pose& pose);
[[nodiscard]] Pose pose_from_wire(const PoseMessage& wire);

[[nodiscard]] PlanningInputMessage planning_to_wire(const coordination::PlanningInput& input);
/// Numbers are finite, and there are no more entries than any program sends.
[[nodiscard]] bool is_valid(const PlanningInputMessage& wire);
/// @pre is_valid
[[nodiscard]] coordination::PlanningInput planning_from_wire(const PlanningInputMessage& wire);

}  // namespace hlc::dds
