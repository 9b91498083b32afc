#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "hlc_bridge/result/run_record.hpp"

namespace hlc::result {

/// Where two runs begin to differ, and in what.
struct Difference {
  std::uint64_t step{};  ///< from 0, StepRecord::step
  VehicleId vehicle;
  /// One line that begins with the kind of the difference and has both values with their units,
  /// first that of the first run: "input: driven x 1.2345 m and 1.2346 m, 0.1 mm apart".
  std::string text;
};

/// The first step in which two runs differ. Of the vehicles that differ in it the one whose kind of
/// difference comes first here, because a later kind may be its consequence; of equal kinds the
/// smallest id:
///
/// | kind     | compares |
/// |---|---|
/// | reports  | whether both runs have a report of the vehicle in this step |
/// | input    | driven pose and speed at t(k), measured deviation |
/// | messages | missing vehicles, coupled vehicles, computation level |
/// | plan     | status with reason and vehicles that block the plan, waiting, cost, quality, gap, |
/// |          | vertices, and of the plan in force planned pose, trim, maneuver; subgraph |
///
/// Of one kind, the first in this order counts. Numbers are compared by their bits, as in
/// trace_sha256: 0.0 and -0.0 differ. Nothing measured by a clock counts: planning time, response
/// time, missed deadlines. The numbers k of the first steps may differ.
/// @return nothing: the runs are equal
/// @pre each has at most one row per step and vehicle, as of step_records()
[[nodiscard]] std::optional<Difference> first_difference(std::span<const StepRecord> a,
                                                         std::span<const StepRecord> b);

/// The driven poses of two runs, compared bit for bit.
struct WayDifference {
  /// The first step in which a vehicle drives elsewhere, with the smallest id of those, and how far
  /// apart: "1.2 mm apart"; none: nowhere where both poses are recorded.
  std::optional<Difference> first;
  bool is_complete{true};  ///< every row has its counterpart, both with a driven pose
};
[[nodiscard]] WayDifference way_difference(std::span<const StepRecord> a,
                                           std::span<const StepRecord> b);
/// "the first car to drive elsewhere: step 9 (1.8 s), vehicle 1: 1.2 mm apart", or that none does.
[[nodiscard]] std::string text_of(const WayDifference& difference, double step_s);

/// "step 57 (11.4 s), vehicle 3: input: ...".
[[nodiscard]] std::string text_of(const Difference& difference, double step_s);

}  // namespace hlc::result
