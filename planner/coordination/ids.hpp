#pragma once

#include <compare>
#include <cstdint>

/// Identifiers of vehicles and control steps, used by every room.
namespace hlc {

struct VehicleId {
  std::uint8_t value{};
  friend auto operator<=>(const VehicleId&, const VehicleId&) = default;
};

/// Vehicles within one process are numbered 1 ... 255.
inline constexpr std::uint8_t kMaxVehicleId = 255;
/// The lab numbers its vehicles 1 ... 30: its programs and the topics of DDS know no others.
inline constexpr std::uint8_t kMaxLabVehicleId = 30;

/// Number k = t_now / period of the control step, from the time stamp and never from a count of
/// receipts, so equal numbers mean the same instant in every controller. t(k) = k * period.
struct StepIndex {
  std::uint64_t value{};
  friend auto operator<=>(const StepIndex&, const StepIndex&) = default;
};

}  // namespace hlc
