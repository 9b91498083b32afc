#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <vector>

#include "hlc_bridge/messages/run_messages.hpp"

/// What the controllers of a run reported.
namespace hlc::test {

/// Of a run that is under way; none while there is no file with a heading.
[[nodiscard]] std::vector<ReportRecord> reports_so_far(const std::filesystem::path& run_folder);

[[nodiscard]] std::optional<coordination::Report> last_report(
    const std::vector<ReportRecord>& records, VehicleId vehicle);

/// Number of steps in which the vehicle planned, from `first` on.
[[nodiscard]] std::size_t planned_steps(const std::vector<ReportRecord>& records, VehicleId vehicle,
                                        StepIndex first = {});

[[nodiscard]] bool is_among(VehicleId vehicle, const std::vector<VehicleId>& vehicles);

}  // namespace hlc::test
