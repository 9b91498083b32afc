#include "hlc_bridge/hlc/placement_line.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace hlc::high_level_controller {
namespace {

std::uint8_t id_of(const controller::Controller& controller) {
  return controller.options().vehicle.value;
}

}  // namespace

std::string placement_line(const controller::Controller& controller) {
  const road::Placement& placement = controller.placement().value();
  const std::string& route = controller.route().name;
  if (controller.fits_route()) {
    return fmt::format(
        "vehicle {} selects route {}{} at {:.3f} m, {:.0f} mm beside its path, turned by {:.3f} "
        "rad",
        id_of(controller), route, controller.routes().size() > 1 ? " (best fit)" : "",
        placement.s_m, 1e3 * placement.distance_m, placement.turned_rad);
  }
  const Pose car = controller.plan_in_force().pose_at(controller.last_step());
  const Point place = controller.route().path.at(placement.s_m);
  return fmt::format(
      "vehicle {} fits no route: nearest is {} at {:.3f} m; move it by x {:+.2f} m, y {:+.2f} m to "
      "({:.2f}, {:.2f}) and turn it by {:+.2f} rad; it reaches {:.0f} mm beyond the lanes "
      "(must be <= {:.0f} mm), is turned by {:.3f} rad (must be <= {:.3f} rad){}",
      id_of(controller), route, placement.s_m, place.x() - car.x_m, place.y() - car.y_m, place.x(),
      place.y(), -placement.turned_rad, 1e3 * std::max(0.0, placement.beyond_m()),
      1e3 * road::kFitsBeyond_m, placement.turned_rad, road::kFitsTurned_rad,
      placement.is_on_ground ? "" : ", and is not on the map");
}

std::string stuck_line(const controller::Controller& controller,
                       coordination::FallbackReason reason) {
  if (reason == coordination::FallbackReason::kBudget) {
    return fmt::format("vehicle {}: no new plan, the search used up max_expansions = {}",
                       id_of(controller), controller.options().search.max_expansions);
  }
  return fmt::format("vehicle {} stands: no plan of {} steps leads into the lanes of route {}",
                     id_of(controller), controller.options().horizon_steps,
                     controller.route().name);
}

std::string elsewhere_line(const controller::Controller& controller) {
  const Pose car = controller.measured_vehicle()->pose;
  const Pose plan = controller.plan_in_force().pose_at(controller.last_step());
  return fmt::format(
      "vehicle {} is elsewhere: at ({:.2f}, {:.2f}), its plan at ({:.2f}, {:.2f}); nothing is sent "
      "to it until it stands, then it is planned from there: put it into the lanes of route {}",
      id_of(controller), car.x_m, car.y_m, plan.x_m, plan.y_m, controller.route().name);
}

}  // namespace hlc::high_level_controller
