#include "hlc_bridge/result/run_record.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "hlc_bridge/messages/time_grid.hpp"

namespace hlc::result {
namespace {

constexpr Nanoseconds kWidestGap = 100'000'000;

/// An instant of a record: `part` of the time from one sample to the next has passed.
struct SamplesAround {
  const DrivenSample& before;
  const DrivenSample& after;
  double part{};
};

std::optional<SamplesAround> samples_around(std::span<const DrivenSample> drive, Nanoseconds t) {
  const auto after = std::lower_bound(
      drive.begin(), drive.end(), t,
      [](const DrivenSample& sample, Nanoseconds time) { return sample.t < time; });
  if (after == drive.end()) return std::nullopt;
  if (after->t == t) return SamplesAround{*after, *after};
  if (after == drive.begin()) return std::nullopt;
  const DrivenSample& before = *std::prev(after);
  if (after->t - before.t > kWidestGap) return std::nullopt;
  return SamplesAround{
      before, *after, static_cast<double>(t - before.t) / static_cast<double>(after->t - before.t)};
}

}  // namespace

std::optional<std::uint64_t> first_step_of(std::span<const ReportRecord> reports) {
  std::optional<std::uint64_t> first;
  for (const ReportRecord& record : reports) {
    if (record.report.status != coordination::StepStatus::kStandby) {
      const std::uint64_t step = record.report.step.value;
      first = std::min(first.value_or(step), step);
    }
  }
  return first;
}

std::optional<Pose> driven_pose_at(std::span<const DrivenSample> drive, Nanoseconds t) {
  const std::optional<SamplesAround> at = samples_around(drive, t);
  if (!at) return std::nullopt;
  const Pose& a = at->before.pose;
  const Pose& b = at->after.pose;
  if (at->part == 0.0) return a;
  const double turn_rad = wrap_angle(b.heading_rad - a.heading_rad);
  return Pose{a.x_m + at->part * (b.x_m - a.x_m), a.y_m + at->part * (b.y_m - a.y_m),
              a.heading_rad + at->part * turn_rad};
}

std::optional<double> driven_speed_mps_at(std::span<const DrivenSample> drive, Nanoseconds t) {
  const std::optional<SamplesAround> at = samples_around(drive, t);
  if (!at) return std::nullopt;
  return std::lerp(at->before.speed_mps, at->after.speed_mps, at->part);
}

std::vector<StepRecord> step_records(std::span<const ReportRecord> reports, const Drives& drives,
                                     const RunFacts& facts) {
  std::map<std::pair<std::uint64_t, std::uint8_t>, StepRecord> rows;
  for (const ReportRecord& record : reports) {
    const std::uint64_t k = record.report.step.value;
    if (!facts.first_step || k < *facts.first_step || k - *facts.first_step >= facts.steps) {
      continue;
    }
    const std::uint64_t step = k - *facts.first_step;
    StepRecord row{.step = step,
                   .record = record,
                   .driven = {},
                   .t_s = static_cast<double>(step * facts.period) /
                          static_cast<double>(kNanosecondsPerSecond)};
    const auto drive = drives.find(record.report.vehicle.value);
    if (drive != drives.end()) {
      row.driven = driven_pose_at(drive->second, k * facts.period);
      row.driven_speed_mps = driven_speed_mps_at(drive->second, k * facts.period);
    }
    rows.insert_or_assign({row.step, record.report.vehicle.value}, std::move(row));
  }
  std::vector<StepRecord> sorted;
  sorted.reserve(rows.size());
  for (auto& [key, row] : rows) {
    sorted.push_back(std::move(row));
  }
  return sorted;
}

std::span<const StepRecord> rows_before(std::span<const StepRecord> rows, std::uint64_t step) {
  const auto end = std::ranges::lower_bound(rows, step, {}, &StepRecord::step);
  return rows.first(static_cast<std::size_t>(end - rows.begin()));
}

}  // namespace hlc::result
