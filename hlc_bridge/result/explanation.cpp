#include "hlc_bridge/result/explanation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <map>
#include <utility>

namespace hlc::result {
namespace {

using VehicleRows = std::vector<const StepRecord*>;

constexpr double kStanding_mps = 0.025;
/// One that has been slower since its last stand was not under way again.
constexpr double kMoving_mps = 0.1;
/// Of measured speeds.
constexpr double kNoise_mps = 0.01;

/// VehicleRows of one stretch.
struct Stretch {
  std::size_t first{};
  std::size_t last{};
};

std::vector<Stretch> stretches(const VehicleRows& rows,
                               const std::function<bool(const StepRecord&)>& is_in) {
  std::vector<Stretch> found;
  bool was_in = false;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const bool is_in_now = is_in(*rows[i]);
    if (is_in_now && !was_in) found.push_back({i, i});
    if (is_in_now) found.back().last = i;
    was_in = is_in_now;
  }
  return found;
}

constexpr std::array<bool (*)(const coordination::Report&), 4> kHindrances{
    [](const coordination::Report& report) {
      return report.status == coordination::StepStatus::kFallback;
    },
    [](const coordination::Report& report) {
      return report.status == coordination::StepStatus::kMinimalRiskStop;
    },
    [](const coordination::Report& report) { return !report.waiting.vehicles.empty(); },
    [](const coordination::Report& report) { return !report.missing.empty(); }};

double speed_mps(const StepRecord& row) { return std::abs(row.driven_speed_mps.value_or(0.0)); }

/// Of a vehicle that stands from row `stand` on: the first row whose plan brakes. The plan of a
/// step is driven from the next one on.
std::optional<std::size_t> first_braking_row(const VehicleRows& rows, std::size_t stand) {
  std::size_t fastest = stand;
  while (fastest > 0 && speed_mps(*rows[fastest - 1]) > speed_mps(*rows[fastest]) + kNoise_mps) {
    --fastest;
  }
  if (speed_mps(*rows[fastest]) < kMoving_mps) return std::nullopt;
  return fastest > 0 ? fastest - 1 : 0;
}

bool is_hindered(const StepRecord& row) {
  return std::ranges::any_of(kHindrances,
                             [&](const auto& is_one) { return is_one(row.record.report); });
}

/// Rows to explain, each with the last row that its explanation is about.
class ExplainedRows {
 public:
  explicit ExplainedRows(const VehicleRows& rows) : rows_(rows) {
    for (const auto& is_one : kHindrances) {
      const auto has_it = [&](const StepRecord& row) { return is_one(row.record.report); };
      for (const Stretch& one : stretches(rows, has_it)) add(one.first, one.last);
    }
    const auto stands = [](const StepRecord& row) {
      return row.driven_speed_mps && speed_mps(row) < kStanding_mps;
    };
    for (const Stretch& one : stretches(rows, stands)) add_braking(one);
  }

  [[nodiscard]] const std::map<std::size_t, std::size_t>& last_by_first() const {
    return last_by_first_;
  }

 private:
  void add(std::size_t first, std::size_t last) {
    std::size_t& known = last_by_first_[first];
    known = std::max(known, last);
  }

  /// Every row whose plan brakes; the last of them explains the stand, too. The plan of a step is
  /// driven in the next one, at whose end the vehicle stands: two rows before the first such row.
  void add_braking(const Stretch& stand) {
    const auto first = first_braking_row(rows_, stand.first);
    if (!first) return;
    const std::size_t last = stand.first >= *first + 2 ? stand.first - 2 : *first;
    for (std::size_t row = *first; row <= last; ++row) {
      if (!is_hindered(*rows_[row])) add(row, row == last ? stand.last : row);
    }
  }

  const VehicleRows& rows_;
  std::map<std::size_t, std::size_t> last_by_first_;
};

}  // namespace

std::vector<Explanation> steps_to_explain(std::span<const StepRecord> rows) {
  std::map<VehicleId, VehicleRows> rows_of;
  for (const StepRecord& row : rows) {
    const coordination::Report& report = row.record.report;
    if (report.status != coordination::StepStatus::kStandby) {
      rows_of[report.vehicle].push_back(&row);
    }
  }
  std::vector<Explanation> steps;
  for (const auto& [vehicle, own] : rows_of) {
    const ExplainedRows explained(own);
    for (const auto& [first, last] : explained.last_by_first()) {
      steps.push_back(
          {.step = own[first]->step, .last = own[last]->step, .vehicle = vehicle, .text = {}});
    }
  }
  std::ranges::stable_sort(steps, {}, &Explanation::step);
  return steps;
}

}  // namespace hlc::result
