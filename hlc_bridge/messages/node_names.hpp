#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "hlc_bridge/messages/messages.hpp"

/// Names of a run's processes, by vehicle and independent of --node_id: all their participants have
/// them, and so does the ready status of vehicles.
namespace hlc {

inline constexpr const char* kLabControlName = "lab_control";

[[nodiscard]] inline std::string vehicle_name(std::uint8_t vehicle_id) {
  return "vehicle_raspberry_" + std::to_string(vehicle_id);
}

[[nodiscard]] inline std::string middleware_name(std::uint8_t vehicle_id) {
  return "middleware_" + std::to_string(vehicle_id);
}

[[nodiscard]] inline std::string controller_name(std::uint8_t vehicle_id) {
  return "high_level_controller_" + std::to_string(vehicle_id);
}

/// source_id with which a controller reports to its middleware that it is ready.
[[nodiscard]] inline std::string controller_ready_id(std::uint8_t vehicle_id) {
  return "hlc_" + std::to_string(vehicle_id);
}

/// source_id with which a middleware reports to the lab control that its controllers are ready.
[[nodiscard]] inline std::string middleware_ready_id(std::span<const std::uint8_t> vehicle_ids) {
  std::string ids;
  for (const std::uint8_t id : vehicle_ids) {
    ids += (ids.empty() ? "" : ", ") + std::to_string(id);
  }
  return "MW for muCars " + ids + " ready.";
}

[[nodiscard]] inline std::string middleware_ready_id(std::uint8_t vehicle_id) {
  return middleware_ready_id(std::span{&vehicle_id, 1});
}

}  // namespace hlc
