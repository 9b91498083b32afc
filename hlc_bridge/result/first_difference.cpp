#include "hlc_bridge/result/first_difference.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <map>
#include <string_view>
#include <utility>
#include <vector>

#include "hlc_bridge/result/waits.hpp"
#include "planner/common/yaml_text.hpp"

namespace hlc::result {
namespace {

using coordination::Report;
using Rows = std::span<const StepRecord>;

/// In the order in which one causes the next.
enum class Kind : std::uint8_t { kReports, kInput, kMessages, kPlan };

constexpr std::string_view kOnlyFirst = "in the first run only";
constexpr std::string_view kOnlySecond = "in the second run only";

constexpr char kMetres[] = "m";
constexpr char kRadians[] = "rad";
constexpr char kMetresPerSecond[] = "m/s";
constexpr char kSquareMetres[] = "m^2";

bool is_same(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

/// Both in as few digits as show the difference.
std::pair<std::string, std::string> shortest_texts(double a, double b) {
  std::pair<std::string, std::string> texts;
  for (int digits = 5; digits <= std::numeric_limits<double>::max_digits10; ++digits) {
    texts = {fmt::format("{:.{}g}", a, digits), fmt::format("{:.{}g}", b, digits)};
    if (texts.first != texts.second) break;
  }
  return texts;
}

/// Short distances in millimetres.
std::string gap_text(double gap, const std::string& unit) {
  const bool is_short = unit == kMetres && gap < 0.1;
  return is_short ? fmt::format("{:.2g} mm", gap * 1e3) : fmt::format("{:.2g} {}", gap, unit);
}

bool contains(const std::vector<VehicleId>& ids, VehicleId id) {
  return std::ranges::find(ids, id) != ids.end();
}

/// Smallest id that is in one of them only.
std::optional<VehicleId> first_in_one(const std::vector<VehicleId>& a,
                                      const std::vector<VehicleId>& b) {
  std::optional<VehicleId> smallest;
  for (const VehicleId id : a) {
    if (!contains(b, id)) smallest = std::min(smallest.value_or(id), id);
  }
  for (const VehicleId id : b) {
    if (!contains(a, id)) smallest = std::min(smallest.value_or(id), id);
  }
  return smallest;
}

/// Compares the values of one kind one after the other; keeps the first difference.
class Comparison {
 public:
  void texts(std::string_view name, const std::string& a, const std::string& b) {
    if (differs() || a == b) return;
    text_ = fmt::format("{}{}{} and {}", name, name.empty() ? "" : " ", a, b);
  }
  void counts(std::string_view name, std::uint64_t a, std::uint64_t b) {
    texts(name, fmt::to_string(a), fmt::to_string(b));
  }
  void numbers(std::string_view name, const std::string& unit, double a, double b) {
    if (differs() || is_same(a, b)) return;
    const auto [first, second] = shortest_texts(a, b);
    text_ = fmt::format("{} {} {} and {} {}, {} apart", name, first, unit, second, unit,
                        gap_text(std::abs(a - b), unit));
  }
  void poses(std::string_view whose, const Pose& a, const Pose& b) {
    numbers(fmt::format("{} x", whose), kMetres, a.x_m, b.x_m);
    numbers(fmt::format("{} y", whose), kMetres, a.y_m, b.y_m);
    numbers(fmt::format("{} yaw", whose), kRadians, a.heading_rad, b.heading_rad);
  }
  void presence(std::string_view name, bool in_a, bool in_b) {
    if (!differs() && in_a != in_b) {
      text_ = fmt::format("{} {}", name, in_a ? kOnlyFirst : kOnlySecond);
    }
  }
  /// Their order does not count.
  void ids(std::string_view what, const std::vector<VehicleId>& a,
           const std::vector<VehicleId>& b) {
    if (const std::optional<VehicleId> id = first_in_one(a, b)) {
      presence(fmt::format("vehicle {} is {}", id->value, what), contains(a, *id),
               contains(b, *id));
    }
  }

  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  [[nodiscard]] bool differs() const { return !text_.empty(); }

  std::string text_;
};

std::string input_difference(const StepRecord& a, const StepRecord& b) {
  Comparison comparison;
  comparison.presence("driven pose recorded", a.driven.has_value(), b.driven.has_value());
  if (a.driven && b.driven) comparison.poses("driven", *a.driven, *b.driven);
  comparison.presence("driven speed recorded", a.driven_speed_mps.has_value(),
                      b.driven_speed_mps.has_value());
  comparison.numbers("driven speed", kMetresPerSecond, a.driven_speed_mps.value_or(0.0),
                     b.driven_speed_mps.value_or(0.0));
  comparison.numbers("measured deviation", kMetres, a.record.report.deviation_m,
                     b.record.report.deviation_m);
  return comparison.text();
}

std::string message_difference(const Report& a, const Report& b) {
  Comparison comparison;
  comparison.ids("missing", a.missing, b.missing);
  comparison.ids("coupled", a.coupled, b.coupled);
  comparison.counts("computation level", a.level, b.level);
  return comparison.text();
}

/// "fallback (conflict, because of vehicle 2)".
std::string decision_text(const Report& report) {
  std::string text = coordination::to_string(report.status);
  std::string why;
  if (report.reason != coordination::FallbackReason::kNone) {
    why = coordination::to_string(report.reason);
  }
  if (!report.blocked_by.empty()) {
    why += fmt::format("{}because of {}", why.empty() ? "" : ", ",
                       coordination::vehicles_text(report.blocked_by));
  }
  return why.empty() ? text : fmt::format("{} ({})", text, why);
}

std::string waiting_text(const StepRecord& row) {
  const std::optional<std::uint64_t> since = waits_since(row);
  if (!since) return "for none";
  return fmt::format("for {} since step {}",
                     coordination::vehicles_text(row.record.report.waiting.vehicles), *since);
}

std::string quoted(const std::string& name) { return fmt::format("\"{}\"", escaped(name)); }

std::string plan_difference(const StepRecord& row_a, const StepRecord& row_b) {
  const Report& a = row_a.record.report;
  const Report& b = row_b.record.report;
  Comparison comparison;
  comparison.texts("", decision_text(a), decision_text(b));
  comparison.texts("waiting", waiting_text(row_a), waiting_text(row_b));
  comparison.numbers("cost", kSquareMetres, a.cost_m2, b.cost_m2);
  comparison.texts("quality", coordination::to_string(a.quality),
                   coordination::to_string(b.quality));
  comparison.numbers("gap to the optimum", kSquareMetres, a.gap_m2, b.gap_m2);
  comparison.counts("generated vertices", a.generated, b.generated);
  comparison.counts("expanded vertices", a.expanded, b.expanded);
  comparison.poses("planned", a.planned_pose, b.planned_pose);
  comparison.counts("planned trim", a.planned_trim.index + 1, b.planned_trim.index + 1);
  comparison.texts("maneuver", quoted(a.maneuver), quoted(b.maneuver));
  comparison.texts("subgraph", quoted(a.subgraph), quoted(b.subgraph));
  return comparison.text();
}

/// Of one vehicle in one step.
struct Finding {
  Kind kind;
  std::string text;
};

std::optional<Finding> finding_of(const StepRecord& a, const StepRecord& b) {
  if (const std::string text = input_difference(a, b); !text.empty()) {
    return Finding{Kind::kInput, "input: " + text};
  }
  if (const std::string text = message_difference(a.record.report, b.record.report);
      !text.empty()) {
    return Finding{Kind::kMessages, "messages: " + text};
  }
  if (const std::string text = plan_difference(a, b); !text.empty()) {
    return Finding{Kind::kPlan, "plan: " + text};
  }
  return std::nullopt;
}

/// A vehicle's rows of one step; null: there is no report.
struct RowsOfBoth {
  const StepRecord* a{};
  const StepRecord* b{};
};
using Step = std::map<VehicleId, RowsOfBoth>;

std::map<std::uint64_t, Step> steps_of(Rows a, Rows b) {
  std::map<std::uint64_t, Step> steps;
  for (const StepRecord& row : a) steps[row.step][row.record.report.vehicle].a = &row;
  for (const StepRecord& row : b) steps[row.step][row.record.report.vehicle].b = &row;
  return steps;
}

/// "vehicle", or "step" if one run has no report of any vehicle in this step.
const char* unreported(const Step& step) {
  const auto in_a = [](const auto& entry) { return entry.second.a != nullptr; };
  const auto in_b = [](const auto& entry) { return entry.second.b != nullptr; };
  return std::ranges::any_of(step, in_a) && std::ranges::any_of(step, in_b) ? "vehicle" : "step";
}

std::optional<Finding> finding_of(const Step& step, const RowsOfBoth& rows) {
  if (rows.a != nullptr && rows.b != nullptr) return finding_of(*rows.a, *rows.b);
  return Finding{Kind::kReports, fmt::format("reports: this {} {}", unreported(step),
                                             rows.a != nullptr ? kOnlyFirst : kOnlySecond)};
}

std::string apart_text(const Pose& a, const Pose& b) {
  const double apart_m = (a.position_m() - b.position_m()).norm();
  constexpr double kMicrometre_m = 1e-6;
  if (apart_m >= 1.0) return fmt::format("{:.2f} m apart", apart_m);
  if (apart_m >= kMicrometre_m) return fmt::format("{:.3g} mm apart", 1e3 * apart_m);
  return "less than 0.001 mm apart, or turned";
}

}  // namespace

std::optional<Difference> first_difference(Rows a, Rows b) {
  for (const auto& [step, vehicles] : steps_of(a, b)) {
    std::optional<Finding> first;
    VehicleId first_vehicle;
    for (const auto& [vehicle, rows] : vehicles) {
      std::optional<Finding> found = finding_of(vehicles, rows);
      if (!found || (first && first->kind <= found->kind)) continue;
      first = std::move(found);
      first_vehicle = vehicle;
    }
    if (first) return Difference{step, first_vehicle, std::move(first->text)};
  }
  return std::nullopt;
}

WayDifference way_difference(Rows a, Rows b) {
  WayDifference difference;
  for (const auto& [step, vehicles] : steps_of(a, b)) {
    for (const auto& [vehicle, rows] : vehicles) {
      if (rows.a == nullptr || rows.b == nullptr || !rows.a->driven || !rows.b->driven) {
        difference.is_complete = false;
      } else if (!difference.first && *rows.a->driven != *rows.b->driven) {
        difference.first = {step, vehicle, apart_text(*rows.a->driven, *rows.b->driven)};
      }
    }
  }
  return difference;
}

std::string text_of(const WayDifference& difference, double step_s) {
  if (difference.first) {
    return "the first car to drive elsewhere: " + text_of(*difference.first, step_s);
  }
  return difference.is_complete ? "all cars drive the same way"
                                : "where both are recorded, all cars drive the same way";
}

std::string text_of(const Difference& difference, double step_s) {
  return fmt::format("step {} ({:.1f} s), vehicle {}: {}", difference.step,
                     static_cast<double>(difference.step) * step_s, difference.vehicle.value,
                     difference.text);
}

}  // namespace hlc::result
