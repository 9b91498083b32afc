#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "hlc_bridge/messages/run_messages.hpp"

/// What the controllers of a run reported.
namespace hlc::test {

[[nodiscard]] std::optional<coordination::Report> last_report(
    const std::vector<ReportRecord>& records, VehicleId vehicle);

/// Number of steps in which the vehicle planned, from `first` on.
[[nodiscard]] std::size_t planned_steps(const std::vector<ReportRecord>& records, VehicleId vehicle,
                                        StepIndex first = {});

[[nodiscard]] bool is_among(VehicleId vehicle, const std::vector<VehicleId>& vehicles);

}  // namespace hlc::test
