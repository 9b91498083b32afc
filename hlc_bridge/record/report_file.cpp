#include "hlc_bridge/record/report_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <tuple>
#include <utility>

#include "planner/automaton/trim_format.hpp"
#include "planner/common/csv.hpp"
#include "planner/common/text_file.hpp"

namespace hlc::record {
namespace {

constexpr std::string_view kReportHeading =
    "step,id,status,reason,planned_x_m,planned_y_m,planned_heading_rad,planned_trim,cost_m2,"
    "quality,gap_m2,generated,expanded,level,coupled,missing,deviation_m,planning_ns,deadline_"
    "missed,late_ns,maneuver,subgraph,waits_for,waits_since,response_ns,blocked_by,plan,"
    "held_route,held_place_m,held_ahead_m,bound_m2,arrived_since";

constexpr char kEscape = '\\';

/// "5:J2;7:J1": trims from 1, labels in which ; and \ follow a \.
std::string plan_text(const std::vector<coordination::PlannedManeuver>& plan) {
  std::string text;
  for (const auto& [to, label] : plan) {
    if (!text.empty()) text += ';';
    text += fmt::format("{}:", to);
    for (const char letter : label) {
      if (letter == ';' || letter == kEscape) text += kEscape;
      text += letter;
    }
  }
  return text;
}

/// Nothing: no such text.
std::optional<std::vector<coordination::PlannedManeuver>> plan_from(std::string_view text) {
  std::vector<coordination::PlannedManeuver> plan;
  while (!text.empty()) {
    std::size_t trim = 0;
    const char* const end = text.data() + text.size();
    const auto [rest, error] = std::from_chars(text.data(), end, trim);
    if (error != std::errc{} || trim == 0 || rest == end || *rest != ':') return std::nullopt;
    coordination::PlannedManeuver& maneuver = plan.emplace_back();
    maneuver.to = TrimId{trim - 1};
    text.remove_prefix(static_cast<std::size_t>(rest + 1 - text.data()));
    std::size_t i = 0;
    for (; i < text.size() && text[i] != ';'; ++i) {
      if (text[i] == kEscape) ++i;
      if (i < text.size()) maneuver.label += text[i];
    }
    text.remove_prefix(std::min(text.size(), i + 1));
  }
  return plan;
}

std::string line(const ReportRecord& record) {
  const coordination::Report& report = record.report;
  const Pose& pose = report.planned_pose;
  const auto held = [&report](auto coordination::HeldRoad::*value) {
    return report.held ? std::optional(*report.held.*value) : std::nullopt;
  };
  return CsvLine(report.step.value, report.vehicle.value, coordination::to_string(report.status),
                 coordination::to_string(report.reason), pose.x_m, pose.y_m, pose.heading_rad,
                 report.planned_trim.index + 1, report.cost_m2,
                 coordination::to_string(report.quality), report.gap_m2, report.generated,
                 report.expanded, report.level, ids_to_text(report.coupled),
                 ids_to_text(report.missing), report.deviation_m, record.planning_ns,
                 record.deadline_missed, record.late_ns, report.maneuver, report.subgraph,
                 ids_to_text(report.waiting.vehicles), report.waiting.since.value,
                 record.response_ns, ids_to_text(report.blocked_by), plan_text(report.plan),
                 held(&coordination::HeldRoad::route), held(&coordination::HeldRoad::place_m),
                 held(&coordination::HeldRoad::ahead_m), report.bound_m2,
                 report.arrived_since ? std::optional(report.arrived_since->value) : std::nullopt)
      .text();
}

/// The enumerator with this name, among the first `count`.
template <class Enum>
std::optional<Enum> enum_from(const std::string& name, std::uint8_t count) {
  for (std::uint8_t i = 0; i < count; ++i) {
    const auto value = static_cast<Enum>(i);
    if (name == coordination::to_string(value)) {
      return value;
    }
  }
  return std::nullopt;
}

constexpr std::uint8_t kStatuses =
    static_cast<std::uint8_t>(coordination::StepStatus::kMinimalRiskStop) + 1;
constexpr std::uint8_t kQualities =
    static_cast<std::uint8_t>(coordination::PlanQuality::kUnproven) + 1;
constexpr std::uint8_t kReasons =
    static_cast<std::uint8_t>(coordination::FallbackReason::kOffRoute) + 1;

/// Reads the fields of one row from left to right.
class RowReader {
 public:
  RowReader(const CsvTable& table, std::size_t row) : table_{table}, row_{row} {}

  double number() { return table_.number(row_, column_++); }
  std::optional<double> optional_number() {
    if (!table_.text(row_, column_).empty()) return number();
    ++column_;
    return std::nullopt;
  }
  const std::string& text() { return table_.text(row_, column_++); }
  std::uint64_t whole(std::uint64_t least = 0, std::uint64_t most = ~std::uint64_t{0}) {
    const std::uint64_t value = table_.unsigned_number(row_, column_);
    if (value < least || value > most) {
      table_.refuse(row_, column_, fmt::format("in {} ... {}", least, most));
    }
    ++column_;
    return value;
  }
  /// Not after `latest`.
  std::optional<StepIndex> optional_step(StepIndex latest) {
    if (!table_.text(row_, column_).empty()) return StepIndex{whole(0, latest.value)};
    ++column_;
    return std::nullopt;
  }
  template <class Enum>
  Enum name(std::uint8_t count) {
    const std::optional<Enum> value = enum_from<Enum>(table_.text(row_, column_), count);
    if (!value) {
      std::string allowed = "one of ";
      for (std::uint8_t i = 0; i < count; ++i) {
        allowed +=
            (i == 0 ? "" : ", ") + std::string{coordination::to_string(static_cast<Enum>(i))};
      }
      table_.refuse(row_, column_, allowed);
    }
    ++column_;
    return *value;
  }
  std::vector<VehicleId> ids() {
    std::vector<VehicleId> ids;
    if (!table_.text(row_, column_).empty()) {
      for (const std::string& piece : split(table_.text(row_, column_), ';')) {
        if (piece.empty() || piece.size() > 3 ||
            piece.find_first_not_of("0123456789") != std::string::npos || std::stoi(piece) > 255) {
          table_.refuse(row_, column_, "vehicle ids, separated by ;");
        }
        ids.push_back(VehicleId{static_cast<std::uint8_t>(std::stoi(piece))});
      }
    }
    ++column_;
    return ids;
  }

  std::vector<coordination::PlannedManeuver> plan() {
    auto plan = plan_from(table_.text(row_, column_));
    if (!plan) table_.refuse(row_, column_, "TRIM:LABEL, several separated by ;");
    ++column_;
    return *std::move(plan);
  }
  /// Of three columns, empty if there is none.
  std::optional<coordination::HeldRoad> held() {
    if (table_.text(row_, column_).empty()) {
      column_ += 3;
      return std::nullopt;
    }
    const auto route = static_cast<std::uint32_t>(whole(0, ~std::uint32_t{0}));
    const double place_m = length_m();
    return coordination::HeldRoad{route, place_m, length_m()};
  }

 private:
  /// Along a road.
  double length_m() {
    const double value_m = table_.number(row_, column_);
    if (!(std::abs(value_m) <= kLargestCoordinate_m)) {
      table_.refuse(row_, column_, fmt::format("at most {:g} m", kLargestCoordinate_m));
    }
    ++column_;
    return value_m;
  }

  const CsvTable& table_;
  std::size_t row_;
  std::size_t column_{};
};

ReportRecord read_row(RowReader row) {
  ReportRecord record;
  coordination::Report& report = record.report;
  report.step = StepIndex{row.whole()};
  report.vehicle = VehicleId{static_cast<std::uint8_t>(row.whole(0, 255))};
  report.status = row.name<coordination::StepStatus>(kStatuses);
  report.reason = row.name<coordination::FallbackReason>(kReasons);
  report.planned_pose.x_m = row.number();
  report.planned_pose.y_m = row.number();
  report.planned_pose.heading_rad = row.number();
  report.planned_trim = TrimId{row.whole(1) - 1};
  report.cost_m2 = row.number();
  report.quality = row.name<coordination::PlanQuality>(kQualities);
  report.gap_m2 = row.number();
  report.generated = row.whole();
  report.expanded = row.whole();
  report.level = static_cast<std::uint32_t>(row.whole(0, ~std::uint32_t{0}));
  report.coupled = row.ids();
  report.missing = row.ids();
  report.deviation_m = row.number();
  record.planning_ns = row.whole();
  record.deadline_missed = row.whole(0, 1) == 1;
  record.late_ns = row.whole();
  report.maneuver = row.text();
  report.subgraph = row.text();
  report.waiting.vehicles = row.ids();
  report.waiting.since = StepIndex{row.whole(0, report.step.value)};
  record.response_ns = row.whole();
  report.blocked_by = row.ids();
  report.plan = row.plan();
  report.held = row.held();
  report.bound_m2 = row.optional_number();
  report.arrived_since = row.optional_step(report.step);
  return record;
}

}  // namespace

std::string ids_to_text(const std::vector<VehicleId>& ids) {
  std::vector<unsigned> values;
  for (const VehicleId id : ids) values.push_back(id.value);
  return fmt::format("{}", fmt::join(values, ";"));
}

ReportFile::ReportFile(std::filesystem::path file, GrowingFile::OnFailure on_failure)
    : file_{std::move(file), GrowingFile::Opening::kEmptied, std::move(on_failure)} {
  file_.begin(std::string{kReportHeading} + '\n');
}

void ReportFile::append(const ReportRecord& record) {
  std::string text = line(record);
  file_.write(text);
  bytes_ += sizeof(Line) + text.size();
  if (bytes_ > kMostKept) {
    lines_ = {};
  } else {
    lines_.push_back({record.report.step, record.report.vehicle, std::move(text)});
  }
}

std::optional<std::string> ReportFile::finish() {
  if (bytes_ > kMostKept) return file_.close();
  std::ranges::stable_sort(lines_, {}, [](const Line& one) {
    return std::tuple{one.step, one.vehicle};
  });
  std::string text = std::string{kReportHeading} + "\n";
  text.reserve(text.size() + bytes_);
  for (const Line& one : lines_) text += one.text;
  file_.replace(text);
  return file_.close();
}

std::vector<ReportRecord> read_reports(const std::filesystem::path& file) {
  const CsvTable table{file, kReportHeading};
  std::vector<ReportRecord> records;
  records.reserve(table.size());
  for (std::size_t row = 0; row < table.size(); ++row) {
    records.push_back(read_row({table, row}));
  }
  return records;
}

}  // namespace hlc::record
