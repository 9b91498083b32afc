#include "hlc_bridge/hlc/placement_line.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace hlc::high_level_controller {
namespace {

template <class... Values>
std::string text_of(const char* format, Values... values) {
  std::array<char, 256> text{};
  std::snprintf(text.data(), text.size(), format, values...);
  return text.data();
}

std::string vehicle_text(const controller::Controller& controller) {
  return "vehicle " + std::to_string(controller.options().vehicle.value);
}

}  // namespace

std::string placement_line(const controller::Controller& controller) {
  const road::Placement& placement = controller.placement().value();
  const std::string& route = controller.route().name;
  if (controller.fits_route()) {
    return vehicle_text(controller) + " selects route " + route +
           (controller.routes().size() > 1 ? " (best fit)" : "") +
           text_of(" at %.3f m, %.0f mm beside its path, turned by %.3f rad", placement.s_m,
                   1e3 * placement.distance_m, placement.turned_rad);
  }
  return vehicle_text(controller) + " fits no route: nearest is " + route +
         text_of(
             " at %.3f m; it reaches %.0f mm beyond the lanes (must be <= %.0f mm), is turned by "
             "%.3f rad (must be <= %.3f rad)",
             placement.s_m, 1e3 * std::max(0.0, placement.beyond_m()), 1e3 * road::kFitsBeyond_m,
             placement.turned_rad, road::kFitsTurned_rad) +
         (placement.is_on_ground ? "" : ", and is not on the map");
}

std::string stuck_line(const controller::Controller& controller,
                       coordination::FallbackReason reason) {
  if (reason == coordination::FallbackReason::kBudget) {
    return vehicle_text(controller) + ": no new plan, the search used up max_expansions = " +
           std::to_string(controller.options().search.max_expansions);
  }
  const auto n = controller.options().horizon_steps;
  return vehicle_text(controller) + " stands: no plan of " + std::to_string(n) +
         " steps leads into the lanes of route " + controller.route().name;
}

}  // namespace hlc::high_level_controller
