#pragma once

#include <map>

#include "planner/coordination/messages.hpp"
#include "planner/geometry/footprint.hpp"

namespace hlc::closed_loop {

/// Where each vehicle truly is. The others keep clear of a vehicle that stands by its plan where
/// their controllers receive its traffic, and by its measured pose where they do not: these differ
/// by less than the margin.
class StandingAreas {
 public:
  /// @param margin_m  of the planner; measurements may err by kNoise_m
  StandingAreas(const Footprint& footprint, double margin_m)
      : footprint_(footprint), margin_m_(margin_m) {}

  void driven(VehicleId vehicle, const Pose& pose) { poses_[vehicle] = pose; }
  /// @pre it has driven
  [[nodiscard]] ConvexPolygon area(VehicleId vehicle) const {
    return footprint_area(footprint_, poses_.at(vehicle), margin_m_ - kNoise_m);
  }
  [[nodiscard]] bool has(VehicleId vehicle) const { return poses_.contains(vehicle); }

 private:
  static constexpr double kNoise_m = 0.002;

  Footprint footprint_;
  double margin_m_;
  std::map<VehicleId, Pose> poses_;
};

}  // namespace hlc::closed_loop
