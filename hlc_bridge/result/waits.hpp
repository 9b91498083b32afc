#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hlc_bridge/result/run_record.hpp"

/// Standing in a run: vehicles that waited for others (planner/coordination/waiting.hpp), or had
/// arrived.
namespace hlc::result {

struct RunSummary;

/// One waiting of a vehicle, without a break.
struct Wait {
  double duration_s{};              ///< up to the end of the last step in which it waited
  std::uint64_t since_step{};       ///< from 0: k - k0
  std::vector<VehicleId> vehicles;  ///< those it waited for, in the order in which it began to
};

/// Step from which on the vehicle waits in this row, from 0: k - k0; none: it does not wait.
[[nodiscard]] std::optional<std::uint64_t> waits_since(const StepRecord& row);

/// Step since which the vehicle is at its goal in this row, from 0; none: it is not.
[[nodiscard]] std::optional<std::uint64_t> arrived_since(const StepRecord& row);

/// The longest waiting in a vehicle's rows, of equal ones the first; none: it never waited.
[[nodiscard]] std::optional<Wait> longest_wait(std::span<const StepRecord* const> rows,
                                               double step_s);

/// Over all vehicles; 0 if none waited.
[[nodiscard]] double longest_wait_s(const RunSummary& summary);
/// The vehicles that were stuck at the end, in the scenario's order.
[[nodiscard]] std::vector<VehicleId> stuck_vehicles(const RunSummary& summary);

}  // namespace hlc::result
