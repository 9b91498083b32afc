#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <span>
#include <string>

#include "hlc_bridge/messages/messages.hpp"

/// Names of a run's processes, by vehicle and independent of --node_id: all their participants have
/// them, and so does the ready status of vehicles.
namespace hlc {

inline constexpr const char* kLabControlName = "lab_control";

[[nodiscard]] inline std::string vehicle_name(std::uint8_t vehicle_id) {
  return fmt::format("vehicle_raspberry_{}", vehicle_id);
}

[[nodiscard]] inline std::string middleware_name(std::uint8_t vehicle_id) {
  return fmt::format("middleware_{}", vehicle_id);
}

[[nodiscard]] inline std::string controller_name(std::uint8_t vehicle_id) {
  return fmt::format("high_level_controller_{}", vehicle_id);
}

/// source_id with which a controller reports to its middleware that it is ready.
[[nodiscard]] inline std::string controller_ready_id(std::uint8_t vehicle_id) {
  return fmt::format("hlc_{}", vehicle_id);
}

/// source_id with which a middleware reports to the lab control that its controllers are ready.
[[nodiscard]] inline std::string middleware_ready_id(std::span<const std::uint8_t> vehicle_ids) {
  return fmt::format("MW for muCars {} ready.", fmt::join(vehicle_ids, ", "));
}

[[nodiscard]] inline std::string middleware_ready_id(std::uint8_t vehicle_id) {
  return middleware_ready_id(std::span{&vehicle_id, 1});
}

}  // namespace hlc
