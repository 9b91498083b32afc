#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "hlc_bridge/view/page_json.hpp"
#include "hlc_bridge/view/page_messages.hpp"

namespace hlc::view {

/// The scene of a run in the message types that viewers draw by themselves (Foxglove, Lichtblick),
/// in JSON: entities of foxglove.SceneUpdate in the frame "map" of the scenario, metres; an entity
/// replaces the earlier one of its id. Numbers that are not finite are 0.
class Scene {
 public:
  /// @param run  description, map and facts.vehicle_ids; outlives the scene
  explicit Scene(const FinishedRun& run);

  /// Those that take part.
  [[nodiscard]] std::span<const result::VehicleDescription* const> vehicles() const {
    return vehicles_;
  }

  /// Bounds of the lanes, outlines of the obstacles (also of those that a fork adds later), and the
  /// routes of the vehicles: all entities.
  [[nodiscard]] Json map(Nanoseconds time) const;
  /// Footprint and number.
  [[nodiscard]] Json car(const result::VehicleDescription& vehicle, const Pose& pose,
                         Nanoseconds time) const;
  /// The report's plan as far as its maneuvers are known: path, areas, and as metadata the step's
  /// status and the labels.
  [[nodiscard]] Json plan(const result::VehicleDescription& vehicle,
                          const coordination::Report& report, Nanoseconds time) const;

 private:
  [[nodiscard]] Json color_of(const result::VehicleDescription& vehicle, double alpha) const;

  const FinishedRun* run_;
  std::vector<const result::VehicleDescription*> vehicles_;
  std::map<VehicleId, std::size_t> colors_;  ///< numbers
};

/// A foxglove.SceneUpdate.
[[nodiscard]] std::string scene_update(Json entities);

/// {"sec": ..., "nsec": ...}
[[nodiscard]] Json time_json(Nanoseconds time);

}  // namespace hlc::view
