#include "planner/automaton/vehicle_yaml.hpp"

#include <fmt/format.h>

#include <initializer_list>
#include <utility>

#include "planner/common/yaml_text.hpp"
#include "planner/vehicle/lateral_acceleration.hpp"
#include "planner/vehicle/path_curvature.hpp"

namespace hlc::automaton {
namespace {

using Field = std::pair<const char*, double>;

// Values beyond these are no wheeled vehicle's, but given in another unit.
constexpr double kLongest_m = 100.0;
constexpr double kStrongest = 1e4;  // m/s^2, rad/s, 1/m

std::string fields(std::initializer_list<Field> list) {
  std::vector<std::string> texts;
  for (const auto& [key, value] : list) {
    texts.push_back(fmt::format("{}: {}", key, shortest_text(value)));
  }
  return fmt::format("{}", fmt::join(texts, ", "));
}

std::string if_any(const char* key, const std::optional<double>& value) {
  return value ? ", " + fields({{key, *value}}) : "";
}

}  // namespace

vehicle::VehicleParameters read_vehicle(const Node& vehicle) {
  vehicle::VehicleParameters v;
  v.wheelbase_m = vehicle.required<double>("wheelbase_m", above(0.0, kLongest_m));
  v.rear_axle_to_cg_m = vehicle.required<double>("rear_axle_to_cg_m", between(0.0, v.wheelbase_m));
  v.footprint.length_m = vehicle.required<double>("length_m", above(0.0, kLongest_m));
  v.footprint.width_m = vehicle.required<double>("width_m", above(0.0, kLongest_m));
  v.safety_margin_m =
      vehicle.optional("safety_margin_m", v.safety_margin_m, between(0.0, kLongest_m));
  return v;
}

vehicle::IdentifiedVehicle read_identified(const Node& vehicle,
                                           const vehicle::VehicleParameters& parameters,
                                           const vehicle::VehicleLimits& limits) {
  if (vehicle.is_value("identified")) {
    static_cast<void>(vehicle.required<std::string>("identified", one_of({"kinematic"})));
    return vehicle::kinematic_vehicle(parameters, limits);
  }
  const Node identified = vehicle.optional_map("identified");
  vehicle::IdentifiedVehicle v;
  v.path_speed_gain = identified.optional("path_speed_gain", v.path_speed_gain, above(0.0));
  v.path_speed_steering =
      identified.optional("path_speed_steering", v.path_speed_steering, between(-1.0, 0.0));
  v.slip_gain_rad = identified.optional("slip_gain_rad", v.slip_gain_rad);
  v.yaw_rate_gain_per_m =
      identified.optional("yaw_rate_gain_per_m", v.yaw_rate_gain_per_m, above(0.0));
  v.drag_per_s = identified.optional("drag_per_s", v.drag_per_s);
  v.thrust_offset_mps2 = identified.optional("thrust_offset_mps2", v.thrust_offset_mps2);
  v.thrust_per_volt = identified.optional("thrust_per_volt", v.thrust_per_volt);
  v.throttle_exponent = identified.optional("throttle_exponent", v.throttle_exponent, above(0.0));
  v.steering_offset = identified.optional("steering_offset", v.steering_offset);
  v.slip_offset_rad = identified.optional("slip_offset_rad", v.slip_offset_rad);
  if (identified.has("steering_rate_per_s")) {
    v.steering_rate_per_s =
        identified.required<double>("steering_rate_per_s", above(0.0, kStrongest));
  }
  identified.check_no_unknown_keys();
  return v;
}

vehicle::VehicleLimits read_limits(const Node& limits) {
  vehicle::VehicleLimits l;
  l.acceleration_mps2 = limits.required<double>("acceleration_mps2", above(0.0, kStrongest));
  l.steering_rate_radps = limits.required<double>("steering_rate_radps", above(0.0, kStrongest));
  l.speed_min_mps = limits.required<double>("speed_min_mps", between(0.0, kMaxVehicleSpeed_mps));
  l.speed_max_mps =
      limits.required<double>("speed_max_mps", above(l.speed_min_mps, kMaxVehicleSpeed_mps));
  constexpr double kSharpest_rad = 1.5;  // the model has no curvature at pi / 2
  l.steering_max_rad = limits.required<double>("steering_max_rad", above(0.0, kSharpest_rad));
  if (limits.has("friction_mps2")) {
    l.friction_mps2 = limits.required<double>("friction_mps2", above(0.0, kStrongest));
  }
  if (limits.has("curvature_max_per_m")) {
    l.curvature_max_per_m = limits.required<double>("curvature_max_per_m", above(0.0, kStrongest));
  }
  limits.check_no_unknown_keys();
  return l;
}

Trim read_trim(const Node& trim, const vehicle::VehicleParameters& vehicle,
               const vehicle::VehicleLimits& limits) {
  Trim result;
  result.speed_mps =
      trim.required<double>("speed_mps", between(limits.speed_min_mps, limits.speed_max_mps));
  result.steering_rad = trim.required<double>(
      "steering_rad", between(-limits.steering_max_rad, limits.steering_max_rad));
  if (!vehicle::is_within_friction({{}, result.speed_mps, result.steering_rad}, {}, vehicle,
                                   limits)) {
    trim.fail("speed_mps", "less with this steering: the friction circle is exceeded");
  }
  if (!vehicle::is_within_curvature({{}, result.speed_mps, result.steering_rad}, {}, vehicle,
                                    limits)) {
    trim.fail("steering_rad", "less: its path bends more than limits.curvature_max_per_m");
  }
  return result;
}

std::string to_yaml(const vehicle::VehicleParameters& vehicle,
                    const vehicle::IdentifiedVehicle& identified) {
  const vehicle::IdentifiedVehicle& i = identified;
  return "{" +
         fields({{"wheelbase_m", vehicle.wheelbase_m},
                 {"rear_axle_to_cg_m", vehicle.rear_axle_to_cg_m},
                 {"length_m", vehicle.footprint.length_m},
                 {"width_m", vehicle.footprint.width_m},
                 {"safety_margin_m", vehicle.safety_margin_m}}) +
         ", identified: {" +
         fields({{"path_speed_gain", i.path_speed_gain},
                 {"path_speed_steering", i.path_speed_steering},
                 {"slip_gain_rad", i.slip_gain_rad},
                 {"yaw_rate_gain_per_m", i.yaw_rate_gain_per_m},
                 {"drag_per_s", i.drag_per_s},
                 {"thrust_offset_mps2", i.thrust_offset_mps2},
                 {"thrust_per_volt", i.thrust_per_volt},
                 {"throttle_exponent", i.throttle_exponent},
                 {"steering_offset", i.steering_offset},
                 {"slip_offset_rad", i.slip_offset_rad}}) +
         if_any("steering_rate_per_s", i.steering_rate_per_s) + "}}";
}

std::string to_yaml(const vehicle::VehicleLimits& limits) {
  return "{" +
         fields({{"acceleration_mps2", limits.acceleration_mps2},
                 {"steering_rate_radps", limits.steering_rate_radps},
                 {"speed_min_mps", limits.speed_min_mps},
                 {"speed_max_mps", limits.speed_max_mps},
                 {"steering_max_rad", limits.steering_max_rad}}) +
         if_any("friction_mps2", limits.friction_mps2) +
         if_any("curvature_max_per_m", limits.curvature_max_per_m) + "}";
}

}  // namespace hlc::automaton
