#include "hlc_bridge/record/incomplete_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "hlc_bridge/messages/exit_codes.hpp"
#include "hlc_bridge/record/drive_file.hpp"

namespace hlc::record {
namespace {

/// A simulated vehicle may end a few ticks before the last step does.
constexpr Nanoseconds kTolerance = 100'000'000;

double seconds(Nanoseconds t) { return 1e-9 * static_cast<double>(t); }

void check_reports(const result::RunFacts& facts, std::span<const result::StepRecord> rows,
                   std::vector<std::string>& lines) {
  std::map<std::uint8_t, std::uint64_t> reported;  // steps up to the last one, by vehicle
  std::uint64_t most = 0;
  for (const result::StepRecord& row : rows) {
    most = reported[row.record.report.vehicle.value] = row.step + 1;
  }
  for (const std::uint8_t id : facts.vehicle_ids) {
    const std::uint64_t steps = facts.simulated_time ? reported[id] : most;
    if (steps >= facts.steps) continue;
    lines.push_back(fmt::format(
        "reports.csv ends early: {} of {} steps of vehicle {}, to {:.2f} s of {:.2f} s", steps,
        facts.steps, id, seconds(steps * facts.period), seconds(facts.steps * facts.period)));
    return;
  }
}

void check_drive(std::uint8_t id, const result::Drives& drives, Nanoseconds begin, Nanoseconds end,
                 std::vector<std::string>& lines) {
  const std::string file = drive_file({}, id).string();
  const auto drive = drives.find(id);
  if (drive == drives.end()) {
    lines.push_back(fmt::format("{} is missing: vehicle {} has no driven values", file, id));
    return;
  }
  const Nanoseconds last = drive->second.empty() ? 0 : drive->second.back().t;
  if (last + kTolerance >= end) return;
  lines.push_back(fmt::format(
      "{} ends early, at {:.2f} s of {:.2f} s: vehicle {} is not compared with others after that",
      file, seconds(std::max(last, begin) - begin), seconds(end - begin), id));
}

}  // namespace

std::vector<std::string> incomplete_files(const result::RunFacts& facts,
                                          std::span<const result::StepRecord> rows,
                                          const result::Drives& drives) {
  std::vector<std::string> lines;
  if (!facts.first_step) return lines;
  const bool is_driven = is_driven_to_end(facts.exit_code);
  if (is_driven) check_reports(facts, rows, lines);
  const std::uint64_t last_step = rows.empty() ? 0 : rows.back().step;
  const Nanoseconds begin = *facts.first_step * facts.period;
  const Nanoseconds end = begin + (is_driven ? facts.steps : last_step) * facts.period;
  for (const std::uint8_t id : facts.vehicle_ids) check_drive(id, drives, begin, end, lines);
  return lines;
}

}  // namespace hlc::record
