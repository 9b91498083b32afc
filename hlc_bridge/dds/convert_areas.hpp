#pragma once

#include <Area.h>

#include <cmath>
#include <vector>

#include "hlc_bridge/dds/conversion.hpp"

/// Areas in our own types: whatever is valid converts there and back to the same area. Only sources
/// of this folder include this file.
namespace hlc::dds {

/// The search accepts no larger coordinates.
[[nodiscard]] inline bool is_near(double coordinate_m) {
  return std::abs(coordinate_m) <= kLargestCoordinate_m;
}

[[nodiscard]] PolygonMessage polygon_to_wire(const ConvexPolygon& polygon);
/// is_valid_area, and no more corners than any program sends.
[[nodiscard]] bool is_valid(const PolygonMessage& wire);
/// Without consecutive duplicate corners. @pre is_valid
[[nodiscard]] ConvexPolygon polygon_from_wire(const PolygonMessage& wire);

[[nodiscard]] std::vector<PolygonMessage> polygons_to_wire(
    const std::vector<ConvexPolygon>& areas_m);
[[nodiscard]] bool are_valid(const std::vector<PolygonMessage>& wire);
/// @pre are_valid
[[nodiscard]] std::vector<ConvexPolygon> polygons_from_wire(
    const std::vector<PolygonMessage>& wire);

[[nodiscard]] AreasMessage areas_to_wire(const coordination::OccupiedAreas& areas);
[[nodiscard]] bool is_valid(const AreasMessage& wire);
/// @pre is_valid
[[nodiscard]] coordination::OccupiedAreas areas_from_wire(const AreasMessage& wire);

}  // namespace hlc::dds
