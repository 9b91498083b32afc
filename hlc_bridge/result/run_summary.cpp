#include "hlc_bridge/result/run_summary.hpp"

#include <algorithm>
#include <iterator>

#include "hlc_bridge/messages/exit_codes.hpp"
#include "hlc_bridge/result/encounters.hpp"
#include "hlc_bridge/result/joint_gaps.hpp"
#include "hlc_bridge/result/planned_motion.hpp"
#include "hlc_bridge/result/trace_hash.hpp"
#include "planner/automaton/deviation.hpp"
#include "planner/road/lap.hpp"

namespace hlc::result {
namespace {

constexpr double kSecondsPerNanosecond = 1e-9;

bool has_planned(const StepRecord& row) {
  const coordination::StepStatus status = row.record.report.status;
  return status == coordination::StepStatus::kPlanned ||
         status == coordination::StepStatus::kFallback;
}

void add_route(const VehicleDescription& vehicle, std::span<const StepRecord* const> rows,
               double step_s, VehicleSummary& summary) {
  if (!vehicle.route) {
    return;
  }
  std::vector<Point> positions_m;
  std::vector<Point> driven_m;
  std::vector<double> times_s;
  for (const StepRecord* row : rows) {
    positions_m.push_back(row->record.report.planned_pose.position_m());
    if (row->driven) driven_m.push_back(row->driven->position_m());
    times_s.push_back(static_cast<double>(row->step) * step_s);
  }
  const road::Progress progress = road::progress_along(*vehicle.route, positions_m);
  summary.reference_error_m = statistics(progress.distance_m);
  summary.driven_error_m = statistics(road::progress_along(*vehicle.route, driven_m).distance_m);
  const bool from_the_start = !rows.empty() && rows.front()->step == 0;
  summary.lap_s =
      road::lap_s(*vehicle.route, progress, times_s, from_the_start ? road::kFirstStepDriven : 0);
}

void add_speed(std::span<const StepRecord* const> rows, VehicleSummary& summary) {
  std::vector<double> speeds_mps;
  for (const StepRecord* row : rows) {
    if (row->driven_speed_mps) speeds_mps.push_back(*row->driven_speed_mps);
  }
  summary.driven_speed_mps = statistics(speeds_mps);
}

void add_found_plans(std::span<const StepRecord* const> rows, VehicleSummary& summary) {
  std::vector<double> costs_m2;
  std::size_t budget = 0;
  for (const StepRecord* row : rows) {
    const coordination::Report& report = row->record.report;
    if (report.quality == coordination::PlanQuality::kNone) continue;
    costs_m2.push_back(report.cost_m2);
    budget += report.quality == coordination::PlanQuality::kBudget ? 1U : 0U;
  }
  if (costs_m2.empty()) return;
  summary.budget_share = static_cast<double>(budget) / static_cast<double>(costs_m2.size());
  summary.plan_cost_m2 = statistics(costs_m2);
}

void add_search(std::span<const StepRecord* const> rows, double step_s, VehicleSummary& summary) {
  std::vector<double> generated;
  std::vector<double> expanded;
  std::vector<double> planning_s;
  for (const StepRecord* row : rows) {
    summary.fallback_steps +=
        row->record.report.status == coordination::StepStatus::kFallback ? 1U : 0U;
    summary.undrivable_steps +=
        row->record.report.reason == coordination::FallbackReason::kUndrivable ? 1U : 0U;
    summary.deadline_misses += row->record.deadline_missed ? 1U : 0U;
    if (has_planned(*row)) {
      generated.push_back(static_cast<double>(row->record.report.generated));
      expanded.push_back(static_cast<double>(row->record.report.expanded));
      planning_s.push_back(static_cast<double>(row->record.planning_ns) * kSecondsPerNanosecond);
      summary.plans_exceeding_step += planning_s.back() > step_s ? 1U : 0U;
    }
  }
  summary.generated = statistics(generated);
  summary.expanded = statistics(expanded);
  summary.planning_s = statistics(planning_s);
}

/// Compares the drive with the plan, tick by tick. A step that begins or ends near the steering
/// limit may lead away from its plan; the deviation is predicted from there until a step in which
/// the vehicle kept to the margin.
class Tracking {
 public:
  explicit Tracking(const automaton::UniversalAutomaton& automaton) : automaton_(automaton) {}

  void look(const Pose& driven, const vehicle::State& planned) {
    errors_m_.push_back((driven.position_m() - planned.pose.position_m()).norm());
    step_m_ = std::max(step_m_, automaton::footprint_deviation_m(
                                    driven, planned, automaton_.vehicle, automaton_.identified));
  }

  void look(const Drive& drive, Nanoseconds begin, Nanoseconds end, const Pose& pose,
            const automaton::Maneuver& maneuver) {
    const auto is_before = [](const DrivenSample& sample, Nanoseconds t) { return sample.t < t; };
    auto sample = std::lower_bound(drive.begin(), drive.end(), begin, is_before);
    for (; sample != drive.end() && sample->t < end; ++sample) {
      const double time_s = kSecondsPerNanosecond * static_cast<double>(sample->t - begin);
      vehicle::State planned = automaton::state_at(maneuver, time_s, automaton_.vehicle);
      planned.pose = compose(pose, planned.pose);
      look(sample->pose, planned);
    }
    end_step(is_at_limit(maneuver.from) || is_at_limit(maneuver.to));
  }

  void write(VehicleSummary& summary) const {
    summary.tracking_error_m = statistics(errors_m_);
    summary.deviation_max_m = deviation_m_;
  }

 private:
  [[nodiscard]] bool is_at_limit(TrimId trim) const {
    return automaton::is_at_steering_limit(automaton_.trims[trim.index], automaton_.vehicle,
                                           automaton_.identified);
  }

  void end_step(bool is_at_limit) {
    is_foreseen_ = is_at_limit || (is_foreseen_ && step_m_ > automaton_.vehicle.safety_margin_m);
    if (!is_foreseen_) deviation_m_ = std::max(deviation_m_.value_or(0.0), step_m_);
    step_m_ = 0.0;
  }

  const automaton::UniversalAutomaton& automaton_;
  std::vector<double> errors_m_;
  std::optional<double> deviation_m_;
  double step_m_{};  ///< largest deviation in the current step
  bool is_foreseen_{};
};

void add_tracking_at_steps(std::span<const StepRecord* const> rows, VehicleSummary& summary) {
  std::vector<double> errors_m;
  for (const StepRecord* row : rows) {
    if (row->driven) {
      errors_m.push_back(
          (row->driven->position_m() - row->record.report.planned_pose.position_m()).norm());
    }
  }
  summary.tracking_error_m = statistics(errors_m);
}

void add_tracking(std::span<const StepRecord* const> rows, const Drive& drive, Nanoseconds period,
                  const automaton::UniversalAutomaton& automaton, VehicleSummary& summary) {
  Tracking tracking(automaton);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const coordination::Report& report = rows[i]->record.report;
    const StepRecord* next = i + 1 < rows.size() ? rows[i + 1] : nullptr;
    if (const automaton::Maneuver* maneuver = maneuver_during(*rows[i], next, automaton)) {
      const Nanoseconds begin = report.step.value * period;
      tracking.look(drive, begin, begin + period, report.planned_pose, *maneuver);
    } else if (rows[i]->driven && !report.maneuver.empty() &&
               report.planned_trim.index < automaton.trims.size()) {
      const automaton::Trim& trim = automaton.trims[report.planned_trim.index];
      tracking.look(*rows[i]->driven, {.pose = report.planned_pose,
                                       .speed_mps = trim.speed_mps,
                                       .steering_rad = trim.steering_rad});
    }
  }
  tracking.write(summary);
  const double margin_m = automaton.vehicle.safety_margin_m;
  summary.steps_outside_announced_area =
      static_cast<std::size_t>(std::ranges::count_if(rows, [margin_m](const StepRecord* row) {
        return row->record.report.reason == coordination::FallbackReason::kDeviation &&
               row->record.report.deviation_m > margin_m;
      }));
}

/// Steps of the run for which the vehicle has no row: in real time its controller answers only the
/// newest list, and reports the answered steps. A run that ended early has the steps that any
/// vehicle reported.
std::size_t unreported_steps(std::span<const StepRecord* const> own, const RunFacts& facts,
                             std::span<const StepRecord> rows) {
  const std::uint64_t reported = rows.empty() ? 0 : rows.back().step + 1;
  const std::uint64_t steps =
      is_driven_to_end(facts.exit_code) ? facts.steps : std::min(facts.steps, reported);
  const auto there = std::ranges::count_if(own, [&](const auto* row) { return row->step < steps; });
  return steps - std::min<std::size_t>(steps, static_cast<std::size_t>(there));
}

VehicleSummary summarize_vehicle(const VehicleDescription& vehicle,
                                 const RunDescription& description, const RunFacts& facts,
                                 std::span<const StepRecord> rows, const Drives& drives) {
  std::vector<const StepRecord*> own;
  for (const StepRecord& row : rows) {
    if (row.record.report.vehicle == vehicle.id) {
      own.push_back(&row);
    }
  }
  VehicleSummary summary;
  summary.id = vehicle.id;
  summary.name = vehicle.name;
  summary.steps = own.size();
  add_route(vehicle, own, description.step_s, summary);
  add_speed(own, summary);
  add_found_plans(own, summary);
  add_search(own, description.step_s, summary);
  summary.wait = longest_wait(own, description.step_s);
  if (const auto since = own.empty() ? std::nullopt : arrived_since(*own.back())) {
    summary.arrived_s = static_cast<double>(*since) * description.step_s;
  }
  summary.is_stuck =
      !own.empty() && coordination::is_stuck(own.back()->record.report, description.step_s);
  if (!facts.simulated_time) {
    summary.deadline_misses += unreported_steps(own, facts, rows);
  }
  const auto drive = drives.find(vehicle.id.value);
  if (description.automaton && drive != drives.end()) {
    add_tracking(own, drive->second, facts.period, description.automaton->automaton(), summary);
  } else {
    add_tracking_at_steps(own, summary);
  }
  return summary;
}

/// Over the vehicles of a step, of one of the report's counts.
std::size_t largest_sum(std::span<const StepRecord> rows,
                        std::uint64_t coordination::Report::*vertices) {
  std::map<std::uint64_t, std::size_t> sums;
  for (const StepRecord& row : rows) {
    sums[row.step] += row.record.report.*vertices;
  }
  std::size_t largest = 0;
  for (const auto& [step, sum] : sums) {
    largest = std::max(largest, sum);
  }
  return largest;
}

std::optional<Statistics> response_s(std::span<const StepRecord> rows) {
  std::vector<double> times_s;
  for (const StepRecord& row : rows) {
    if (row.record.response_ns == 0) continue;
    times_s.push_back(static_cast<double>(row.record.response_ns) * kSecondsPerNanosecond);
  }
  return statistics(times_s);
}

std::vector<coordination::JointGap> all_joint_gaps(std::span<const StepRecord> rows) {
  std::vector<coordination::JointGap> all;
  for (auto& [step, gaps] : joint_gaps_by_step(rows)) {
    std::ranges::copy(gaps, std::back_inserter(all));
  }
  return all;
}

}  // namespace

RunSummary summarize(const RunDescription& description, const RunFacts& facts,
                     std::span<const StepRecord> rows, const Drives& drives) {
  RunSummary summary;
  summary.description = description;
  summary.steps = rows.empty() ? 0 : rows.back().step + 1;
  for (const VehicleDescription& vehicle : description.vehicles) {
    summary.vehicles.push_back(summarize_vehicle(vehicle, description, facts, rows, drives));
  }
  summary.generated_vertices_sum_max = largest_sum(rows, &coordination::Report::generated);
  summary.expanded_vertices_sum_max = largest_sum(rows, &coordination::Report::expanded);
  summary.joint_gap = coordination::joint_gap_figures(all_joint_gaps(rows));
  if (facts.first_step) {
    const Nanoseconds begin = *facts.first_step * facts.period;
    const Nanoseconds end = begin + facts.steps * facts.period;
    const Encounters close = encounters(description.vehicles, drives, begin, end);
    const Encounters standing = encounters_with(description.obstacles, description.vehicles, drives,
                                                begin, facts.period, end);
    summary.min_footprint_distance_m = close.min_distance_m;
    summary.min_obstacle_distance_m = standing.min_distance_m;
    summary.with_guests =
        guest_encounters(description.vehicles, description.guests, drives, begin, end);
    summary.collisions = close.collisions + standing.collisions + summary.with_guests.collisions;
  }
  summary.wall_s = facts.wall_s;
  summary.realtime_factor = facts.wall_s > 0.0 ? facts.clock_s / facts.wall_s : 0.0;
  summary.response_s = response_s(rows);
  summary.trace_sha256 = trace_sha256(rows);
  return summary;
}

}  // namespace hlc::result
