#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "planner/scenario/scenario.hpp"
#include "tests/integration/driven_plan.hpp"
#include "tests/integration/fault_rules.hpp"

/// The evaluation of a fault of one car's controller or middleware.
namespace hlc::test {

/// The car is coupled with one that is so near that at first nothing new can be planned without it,
/// mostly, and has driven for a while: the silent car may be anywhere within 1.6 m at the end of a
/// plan.
[[nodiscard]] bool drives_near_another(const std::vector<ReportRecord>& so_far, VehicleId victim);

/// The records of a run with one fault.
struct FaultRecords {
  VehicleId victim;
  Nanoseconds fault{};
  result::Drives drives;
  Commands commands;
  std::vector<ReportRecord> reports;
  double tracking_tolerance_m{kTrackingTolerance_m};  ///< by which a car may be off its plan
};

/// The car whose own process is hit cannot get a new plan.
void expect_victim_drives_only_its_last_plan(const FaultRecords& records, Nanoseconds to);
void expect_victim_stands(const FaultRecords& records);

/// The others are affected as long as everything that they could plan may meet the silent car:
/// they drive only their last plans, and stand in time unless they get out of its reach. What
/// they plan again keeps clear of all that the silent car could do.
void expect_others_keep_clear(const FaultRecords& records, const scenario::Scenario& scenario,
                              Nanoseconds to);

}  // namespace hlc::test
