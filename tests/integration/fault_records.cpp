#include "tests/integration/fault_records.hpp"

#include <algorithm>

#include "hlc_bridge/messages/time_grid.hpp"
#include "tests/integration/fault_rules.hpp"
#include "tests/integration/run_reports.hpp"
#include "vehicle_sim/tracking/trajectory.hpp"

namespace hlc::test {
namespace {

constexpr Nanoseconds kPeriod = 200'000'000;
constexpr double kCarWidth_m = 0.107;
constexpr double kNear_m = 0.5;

double distance_m(const Pose& a, const Pose& b) { return (a.position_m() - b.position_m()).norm(); }

/// The first step in which the vehicle missed the silent one and had a new plan, or had none.
std::optional<StepIndex> first_step(const FaultRecords& records, std::uint8_t vehicle,
                                    bool has_planned, StepIndex from = {}) {
  std::optional<StepIndex> first;
  for (const ReportRecord& record : records.reports) {
    const coordination::Report& report = record.report;
    const bool fits = report.vehicle.value == vehicle && report.step >= from &&
                      is_among(records.victim, report.missing) &&
                      has_planned == (report.status == coordination::StepStatus::kPlanned);
    if (fits && (!first || report.step < *first)) first = report.step;
  }
  return first;
}

double top_speed_of(const scenario::Scenario& scenario) {
  double top_mps = 0.0;
  for (const automaton::Trim& trim : scenario.subgraph->automaton().trims) {
    top_mps = std::max(top_mps, trim.speed_mps);
  }
  return top_mps;
}

/// Of every plan that was agreed while the silent car was missing, j steps ahead: it is farther
/// from where that car was seen than that car, driving at its top speed, can have come. Not once
/// it has stood for so long that it counts as an obstacle (missing.hpp).
/// @return how many plans there were
std::size_t expect_new_plans_keep_clear(const FaultRecords& records,
                                        const scenario::Scenario& scenario) {
  std::size_t num_plans = 0;
  constexpr Nanoseconds kStandsForGood = 2'000'000'000;
  const double top_speed_mps = top_speed_of(scenario);
  const result::Drive& silent = records.drives.at(records.victim.value);
  for (const ReportRecord& record : records.reports) {
    const coordination::Report& report = record.report;
    if (report.status != coordination::StepStatus::kPlanned ||
        !is_among(records.victim, report.missing))
      continue;
    const Nanoseconds now = report.step.value * kPeriod;
    const auto seen = result::driven_pose_at(silent, now - kStateDelay);
    const auto stands = standing_since(silent, now);
    const auto command = records.commands.find({report.vehicle.value, now + kListOffset});
    if (!seen || command == records.commands.end() || (stands && *stands + kStandsForGood < now)) {
      continue;
    }
    ++num_plans;
    for (std::uint64_t j = 1; j <= scenario.horizon_steps; ++j) {
      const auto planned = tracking::sample(command->second.points, now + j * kPeriod);
      if (!planned) {
        ADD_FAILURE() << "command of step " << report.step.value << " ends before its plan";
        break;
      }
      const double reach_m = top_speed_mps * 1e-9 * static_cast<double>(j * kPeriod);
      EXPECT_GT((planned->position_m - seen->position_m()).norm(), reach_m + kCarWidth_m)
          << "vehicle " << int{report.vehicle.value} << ", step " << report.step.value << " + "
          << j;
    }
  }
  return num_plans;
}

}  // namespace

bool drives_near_another(const std::vector<ReportRecord>& so_far, VehicleId victim) {
  const std::optional<coordination::Report> own = last_report(so_far, victim);
  if (planned_steps(so_far, victim) < 10 || !own) return false;
  return std::ranges::any_of(own->coupled, [&](VehicleId other) {
    const std::optional<coordination::Report> near = last_report(so_far, other);
    return near && distance_m(near->planned_pose, own->planned_pose) < kNear_m;
  });
}

void expect_victim_drives_only_its_last_plan(const FaultRecords& records, Nanoseconds to) {
  const std::uint8_t victim = records.victim.value;
  expect_only_the_last_plan(records.drives.at(victim), records.commands, victim, records.fault, to,
                            records.tracking_tolerance_m);
}

void expect_victim_stands(const FaultRecords& records) {
  const std::uint8_t victim = records.victim.value;
  expect_stands_in_time(records.drives.at(victim), victim, records.fault);
}

void expect_others_keep_clear(const FaultRecords& records, const scenario::Scenario& scenario,
                              Nanoseconds to) {
  std::size_t judged = 0;
  for (const auto& [id, drive] : records.drives) {
    if (id == records.victim.value) continue;
    SCOPED_TRACE("vehicle " + std::to_string(id));
    const std::optional<StepIndex> fell_back = first_step(records, id, false);
    ASSERT_TRUE(fell_back || first_step(records, id, true)) << "it never missed the silent one";
    if (!fell_back) continue;
    const std::optional<StepIndex> planned_again = first_step(records, id, true, *fell_back);
    // What is planned in a step is driven from the next one on.
    const Nanoseconds free = planned_again ? (planned_again->value + 1) * kPeriod : kForever;
    const Nanoseconds until = std::min(free, to);
    if (fell_back->value * kPeriod > records.fault + kReactionTime) continue;  // came near later
    if (until > records.fault + kReactionTime) {
      expect_only_the_last_plan(drive, records.commands, id, records.fault, until,
                                records.tracking_tolerance_m);
      ++judged;
    }
    if (until > records.fault + kStandingTime && to == kForever) {
      const auto since = standing_since(drive, records.fault + kStandingTime + kVehiclePeriod);
      EXPECT_TRUE(since && *since <= records.fault + kStandingTime);
    }
  }
  judged += expect_new_plans_keep_clear(records, scenario);
  EXPECT_GT(judged, 0U) << "neither a minimal-risk stop nor a new plan";
}

}  // namespace hlc::test
