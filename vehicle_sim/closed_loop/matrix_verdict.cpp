#include "vehicle_sim/closed_loop/matrix_verdict.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>
#include <span>
#include <utility>

#include "hlc_bridge/machine/pacing_rules.hpp"
#include "hlc_bridge/messages/exit_codes.hpp"
#include "hlc_bridge/messages/node_names.hpp"
#include "planner/coordination/missing.hpp"

namespace hlc::closed_loop {
namespace {

constexpr Nanoseconds kStandsFor = kNanosecondsPerSecond;
/// From the first plan of any vehicle until all have departed.
constexpr Nanoseconds kDeparture = kNanosecondsPerSecond;
constexpr Nanoseconds kVisibleDelay = 3 * kNanosecondsPerSecond;
constexpr std::uint64_t kVisibleSteps = 3;
constexpr double kStandstill_s = 2.5;
constexpr double kStandstillWithoutLabControl_s = 7.5;

/// Of the process, or with the text that follows a vehicle's number in log lines.
bool names(const std::string& text, const std::string& process) {
  for (std::size_t at = text.find(process); at != std::string::npos;
       at = text.find(process, at + 1)) {
    const std::size_t end = at + process.size();
    if (end == text.size() || std::isdigit(static_cast<unsigned char>(text[end])) == 0) return true;
  }
  return false;
}

class Comparison {
 public:
  Comparison(const MatrixCell& cell, const MatrixRun& run, const MatrixRun& before)
      : cell_(cell), run_(run), before_(before), begin_(run.faults.front().begin) {
    for (const auto& [car, drive] : before.diary.drives) {
      cars_.insert(car);
      if (name_of({.role = cell.role, .vehicle = car}) == run.culprit) car_ = car;
    }
  }

  MatrixVerdict verdict() {
    verdict_.problems = run_.result.violations;
    verdict_.least_distance_m = run_.result.smallest_distance_m;
    verdict_.standstill_s = time_to_standstill();
    check_exit_codes();
    check_culprit();
    check_blame();
    check_standstill();
    return std::move(verdict_);
  }

 private:
  void fail(const char* check, std::string text) {
    verdict_.problems.push_back({.at = begin_, .check = check, .text = std::move(text)});
  }
  [[nodiscard]] bool is_of_culprit(std::uint8_t car) const {
    return cell_.role == Role::kLabControl || car == car_;
  }
  [[nodiscard]] bool is_for_good() const { return cell_.fault == MatrixFault::kKill; }

  // --- standstill -------------------------------------------------------------------------------

  /// Since when it stands for long, of the time of its drive.
  [[nodiscard]] static std::optional<Nanoseconds> stands_since(
      std::span<const RunDiary::Tick> drive) {
    std::optional<Nanoseconds> since;
    for (const RunDiary::Tick& tick : drive) {
      const bool stands =
          std::abs(tick.speed_mps) <= coordination::MissingVehicleRules{}.standing_speed_mps;
      if (!stands) since.reset();
      if (stands && !since) since = tick.time;
      if (since && tick.time >= *since + kStandsFor) return since;
    }
    return since;
  }

  /// From the fault on, and in the phase `run` only until the run ends.
  [[nodiscard]] std::vector<RunDiary::Tick> drive_since_fault(std::uint8_t car) const {
    std::vector<RunDiary::Tick> drive;
    const auto found = run_.diary.drives.find(car);
    if (found == run_.diary.drives.end()) return drive;
    const bool ends = cell_.phase == MatrixPhase::kRun && run_.diary.stop;
    for (const RunDiary::Tick& tick : found->second) {
      if (tick.at >= begin_ && (!ends || tick.at < *run_.diary.stop)) drive.push_back(tick);
    }
    return drive;
  }

  [[nodiscard]] std::optional<double> time_to_standstill() const {
    if (cell_.phase == MatrixPhase::kStart) return std::nullopt;
    double latest_s = 0.0;
    for (const std::uint8_t car : cars_) {
      const std::vector<RunDiary::Tick> drive = drive_since_fault(car);
      if (!is_of_culprit(car) || drive.empty()) continue;  // it has not begun, or died
      const auto since = stands_since(drive);
      if (!since) return std::nullopt;
      latest_s = std::max(latest_s, 1e-9 * static_cast<double>(*since - drive.front().time));
    }
    return latest_s;
  }

  void check_standstill() {
    if (!is_for_good() || cell_.setup.is_logical || cell_.phase != MatrixPhase::kRun) return;
    const double limit_s =
        cell_.role == Role::kLabControl ? kStandstillWithoutLabControl_s : kStandstill_s;
    if (verdict_.standstill_s && *verdict_.standstill_s <= limit_s) return;
    fail("standstill", "affected cars do not stand within " + std::to_string(limit_s) + " s");
  }

  // --- exit codes -------------------------------------------------------------------------------

  [[nodiscard]] static std::optional<int> code_of(const MatrixRun& run, const std::string& name) {
    const auto found = run.diary.lives.find(name);
    return found == run.diary.lives.end() ? std::nullopt : found->second.exit_code;
  }
  [[nodiscard]] bool is_of_same_car(const std::string& process) const {
    return process == controller_name(car_) || process == middleware_name(car_) ||
           process == vehicle_name(car_);
  }

  [[nodiscard]] bool may_fail(const std::string& process) const {
    const bool never_starts = is_for_good() && cell_.phase == MatrixPhase::kStart;
    if (never_starts && process == kLabControlName) return true;
    // It times out without its middleware.
    if (never_starts && cell_.role == Role::kMiddleware && process == controller_name(car_)) {
      return true;
    }
    if (process == run_.culprit) {
      return cell_.setup.is_logical || cell_.phase == MatrixPhase::kStop;
    }
    if (cell_.role == Role::kLabControl) return cell_.setup.is_logical || is_for_good();
    if (!cell_.setup.is_logical) return false;
    return code_of(run_, kLabControlName) != kExitGood || is_of_same_car(process);
  }

  void check_exit_codes() {
    for (const auto& [name, life] : before_.diary.lives) {
      const std::optional<int> code = code_of(run_, name);
      const bool is_killed = is_for_good() && name == run_.culprit;
      if (!code) {
        if (!is_killed) fail("leftovers", name + " has not ended");
        continue;
      }
      const bool is_failure = *code == kExitMissing || *code == kExitDied;
      if (is_killed || code == life.exit_code || (is_failure && may_fail(name))) continue;
      fail("exit codes", name + " ends with code " + std::to_string(*code));
    }
  }

  // --- culprit ----------------------------------------------------------------------------------

  [[nodiscard]] static bool is_disturbed(const coordination::Report& report) {
    using coordination::FallbackReason;
    return report.status == coordination::StepStatus::kMinimalRiskStop ||
           report.reason == FallbackReason::kMissing ||
           report.reason == FallbackReason::kNeighbour || report.reason == FallbackReason::kLate ||
           report.reason == FallbackReason::kDeviation;
  }
  [[nodiscard]] std::ptrdiff_t disturbed_steps(const MatrixRun& run, std::uint8_t car) const {
    return std::ranges::count_if(run.diary.steps, [&](const RunDiary::Step& step) {
      return step.at >= begin_ && step.report.vehicle.value == car && is_disturbed(step.report);
    });
  }
  /// Its reports pause, or end before those of the others.
  [[nodiscard]] bool is_silent(std::uint8_t car) const {
    std::optional<std::uint64_t> last;
    std::uint64_t last_of_all = 0;
    for (const RunDiary::Step& step : run_.diary.steps) {
      const std::uint64_t number = step.report.step.value;
      last_of_all = std::max(last_of_all, number);
      if (step.report.vehicle.value != car) continue;
      if (last && number > *last + kVisibleSteps) return true;
      last = number;
    }
    return last.value_or(0) + kVisibleSteps < last_of_all;
  }

  [[nodiscard]] bool is_car_affected(std::uint8_t car) const {
    if (disturbed_steps(run_, car) > disturbed_steps(before_, car) || is_silent(car)) return true;
    return stands(run_, car) && !stands(before_, car);
  }
  /// After the fault, while all drive.
  [[nodiscard]] bool stands(const MatrixRun& run, std::uint8_t car) const {
    const auto found = run.diary.drives.find(car);
    if (found == run.diary.drives.end() || !run.diary.begin_of_drive) return false;
    const Nanoseconds from = std::max(begin_, *run.diary.begin_of_drive);
    const Nanoseconds until = run.diary.stop.value_or(kNever);
    std::vector<RunDiary::Tick> drive;
    for (const RunDiary::Tick& tick : found->second) {
      if (tick.at >= from && tick.at < until) drive.push_back(tick);
    }
    if (drive.empty()) return false;
    const Nanoseconds departed = drive.front().time + kDeparture;
    std::erase_if(drive, [departed](const RunDiary::Tick& tick) { return tick.time < departed; });
    return stands_since(drive).has_value();
  }

  [[nodiscard]] bool is_process_affected(const std::string& name,
                                         const RunDiary::Life& life) const {
    if (name == run_.culprit) return false;
    const auto found = run_.diary.lives.find(name);
    if (found == run_.diary.lives.end() || found->second.exit_code != life.exit_code) return true;
    return found->second.end.value_or(0) > life.end.value_or(0) + visible_delay();
  }

  /// Time of the run in logical time stands still while it waits, which it does for so long.
  [[nodiscard]] Nanoseconds visible_delay() const {
    return cell_.setup.is_logical ? machine::logical_rules().patience : kVisibleDelay;
  }

  [[nodiscard]] bool has_effect() const {
    const Nanoseconds drives = run_.diary.begin_of_drive.value_or(kNever);
    return drives > before_.diary.begin_of_drive.value() + visible_delay() ||
           std::ranges::any_of(cars_, [&](std::uint8_t car) { return is_car_affected(car); }) ||
           std::ranges::any_of(before_.diary.lives, [&](const auto& entry) {
             return is_process_affected(entry.first, entry.second);
           });
  }

  [[nodiscard]] bool is_usual(const RunDiary::Line& line) const {
    return std::ranges::any_of(before_.diary.lines, [&](const RunDiary::Line& other) {
      return other.process == line.process && other.line.text == line.line.text;
    });
  }

  [[nodiscard]] std::string naming_line() const {
    const std::string number = "vehicle " + std::to_string(car_);
    for (const RunDiary::Line& line : run_.diary.lines) {
      if (line.at < begin_ || line.process == run_.culprit) continue;
      const bool has_number = cell_.role == Role::kVehicle &&
                              line.line.severity != machine::Severity::kInfo &&
                              names(line.line.text, number);
      const bool is_named = has_number || names(line.line.text, run_.culprit);
      if (is_named && !is_usual(line)) return line.process + ": " + line.line.text;
    }
    for (const RunDiary::Line& line : run_.diary.progress) {
      const bool is_late = line.at >= std::max(begin_, before_.diary.begin_of_drive.value());
      if (is_late && names(line.line.text, run_.culprit)) {
        return line.process + ": " + line.line.text;
      }
    }
    return {};
  }

  [[nodiscard]] bool names_car(const coordination::Report& report) const {
    const auto has = [this](const std::vector<VehicleId>& vehicles) {
      return std::ranges::count(vehicles, VehicleId{car_}) > 0;
    };
    return report.vehicle.value != car_ &&
           (has(report.missing) || (is_disturbed(report) && has(report.blocked_by)));
  }
  [[nodiscard]] std::ptrdiff_t naming_reports(const MatrixRun& run) const {
    return std::ranges::count_if(run.diary.steps, [this](const RunDiary::Step& step) {
      return step.at >= begin_ && names_car(step.report);
    });
  }
  [[nodiscard]] std::string naming_report() const {
    const std::ptrdiff_t count = naming_reports(run_);
    if (cell_.role == Role::kLabControl || count <= naming_reports(before_)) return {};
    return std::to_string(count) + " reports of others name vehicle " + std::to_string(car_);
  }

  void check_culprit() {
    verdict_.named_by = naming_line();
    verdict_.naming = Naming::kLog;
    if (!verdict_.named_by.empty()) return;
    verdict_.named_by = naming_report();
    verdict_.naming = Naming::kReport;
    if (!verdict_.named_by.empty()) return;
    verdict_.naming = has_effect() ? Naming::kNone : Naming::kNoEffect;
    if (verdict_.naming == Naming::kNone && cell_.fault == MatrixFault::kClockStep) {
      verdict_.naming = Naming::kByItself;
    }
    if (verdict_.naming == Naming::kNone) {
      fail("culprit", "nothing names " + run_.culprit + ", though its fault has an effect");
    }
  }

  // --- blame ------------------------------------------------------------------------------------

  /// In logical time the run ends, and its result lists first what the others wait for.
  [[nodiscard]] bool names_first(const std::string& result) const {
    return cell_.setup.is_logical && result.starts_with("died: " + run_.culprit);
  }

  [[nodiscard]] bool is_dead(const std::string& process, Nanoseconds at) const {
    const auto found = run_.diary.lives.find(process);
    const bool has_left =
        found != run_.diary.lives.end() && found->second.end && *found->second.end <= at;
    return process == run_.culprit || has_left;
  }

  void check_blame() {
    if (cell_.role == Role::kLabControl) return;
    std::string blamed;
    for (const RunDiary::Line& line : run_.diary.lines) {
      const std::string& text = line.line.text;
      if (line.process != kLabControlName) continue;
      if (names_first(text)) return;
      const std::size_t end = text.find(" died: ");
      if (end == std::string::npos || !blamed.empty()) continue;
      if (!is_dead(text.substr(0, end), line.at)) blamed = text;
    }
    if (!blamed.empty()) fail("blame", blamed);
  }

  const MatrixCell& cell_;
  const MatrixRun& run_;
  const MatrixRun& before_;
  Nanoseconds begin_;
  std::set<std::uint8_t> cars_;
  std::uint8_t car_{};  ///< of the process; 0: the lab control's
  MatrixVerdict verdict_;
};

}  // namespace

MatrixVerdict verdict_of(const MatrixCell& cell, const MatrixRun& run, const MatrixRun& before) {
  return Comparison(cell, run, before).verdict();
}

}  // namespace hlc::closed_loop
