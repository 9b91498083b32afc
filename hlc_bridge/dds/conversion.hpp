#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "hlc_bridge/messages/messages.hpp"
#include "planner/coordination/messages.hpp"

/// Common to all conversions. Only sources of this folder include this file.
namespace hlc::dds {

/// Result of converting a received message.
template <class Message>
struct Incoming {
  std::optional<Message> message;  ///< nothing: invalid as a whole
  std::uint64_t invalid{};         ///< entries left out, or 1 for the whole
};

template <class Message>
[[nodiscard]] Incoming<Message> valid_if(bool valid, const Message& message) {
  return valid ? Incoming<Message>{message, 0} : Incoming<Message>{std::nullopt, 1};
}

/// A message with more entries than this is neither ours nor the lab's.
inline constexpr std::size_t kMaxEntries = 1000;
inline constexpr std::size_t kMaxText = 65'536;

template <class... Numbers>
[[nodiscard]] bool all_finite(Numbers... numbers) {
  return (std::isfinite(numbers) && ...);
}

[[nodiscard]] inline bool is_finite(const Pose& pose) {
  return all_finite(pose.x_m, pose.y_m, pose.heading_rad);
}

[[nodiscard]] constexpr bool is_valid(VehicleId vehicle) {
  return 1 <= vehicle.value && vehicle.value <= kMaxLabVehicleId;
}

}  // namespace hlc::dds
