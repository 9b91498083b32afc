#include "hlc_bridge/result/run_record.hpp"

#include <algorithm>
#include <utility>

namespace hlc::result {
namespace {

constexpr Nanoseconds kWidestGap = 100'000'000;

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
  const auto after = std::lower_bound(
      drive.begin(), drive.end(), t,
      [](const DrivenSample& sample, Nanoseconds time) { return sample.t < time; });
  if (after == drive.end()) {
    return std::nullopt;
  }
  if (after->t == t) {
    return after->pose;
  }
  if (after == drive.begin()) {
    return std::nullopt;
  }
  const DrivenSample& a = *std::prev(after);
  const DrivenSample& b = *after;
  if (b.t - a.t > kWidestGap) {
    return std::nullopt;
  }
  const double part = static_cast<double>(t - a.t) / static_cast<double>(b.t - a.t);
  const double turn_rad = wrap_angle(b.pose.heading_rad - a.pose.heading_rad);
  return Pose{a.pose.x_m + part * (b.pose.x_m - a.pose.x_m),
              a.pose.y_m + part * (b.pose.y_m - a.pose.y_m), a.pose.heading_rad + part * turn_rad};
}

std::vector<StepRecord> step_records(std::span<const ReportRecord> reports, const Drives& drives,
                                     const RunFacts& facts) {
  std::map<std::pair<std::uint64_t, std::uint8_t>, StepRecord> rows;
  for (const ReportRecord& record : reports) {
    const std::uint64_t k = record.report.step.value;
    if (!facts.first_step || k < *facts.first_step || k - *facts.first_step >= facts.steps) {
      continue;
    }
    StepRecord row{k - *facts.first_step, record, std::nullopt};
    const auto drive = drives.find(record.report.vehicle.value);
    if (drive != drives.end()) {
      row.driven = driven_pose_at(drive->second, k * facts.period);
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

}  // namespace hlc::result
