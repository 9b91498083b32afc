#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "hlc_bridge/messages/messages.hpp"

/// Names of a run's processes, by vehicle and independent of --node_id: all their participants have
/// them, and so does the ready status of vehicles.
///
/// A middleware or simulator that serves several vehicles is one participant, "middleware_1,2,3";
/// for all others it is each of the processes that it stands for (process_names).
namespace hlc {

inline constexpr const char* kLabControlName = "lab_control";

[[nodiscard]] inline std::string vehicle_name(std::uint8_t vehicle_id) {
  return fmt::format("vehicle_raspberry_{}", vehicle_id);
}

[[nodiscard]] inline std::string vehicle_name(std::span<const std::uint8_t> vehicle_ids) {
  return fmt::format("vehicle_raspberry_{}", fmt::join(vehicle_ids, ","));
}

[[nodiscard]] inline std::string middleware_name(std::uint8_t vehicle_id) {
  return fmt::format("middleware_{}", vehicle_id);
}

[[nodiscard]] inline std::string middleware_name(std::span<const std::uint8_t> vehicle_ids) {
  return fmt::format("middleware_{}", fmt::join(vehicle_ids, ","));
}

[[nodiscard]] inline std::string controller_name(std::uint8_t vehicle_id) {
  return fmt::format("high_level_controller_{}", vehicle_id);
}

/// Of who drives a guest by hand.
[[nodiscard]] inline std::string driver_name(std::uint8_t vehicle_id) {
  return fmt::format("driver_{}", vehicle_id);
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

/// Names of the processes that a participant's name, or a timer's source_id, stands for:
/// "middleware_1", "middleware_2" for "middleware_1,2"; any other name stands for itself.
[[nodiscard]] std::vector<std::string> process_names(const std::string& name);

/// The same for a ready status: source_ids of middlewares with one vehicle each for
/// "MW for muCars 1, 2 ready."; any other one for itself.
[[nodiscard]] std::vector<std::string> single_ready_ids(const std::string& source_id);

}  // namespace hlc
