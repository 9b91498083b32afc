#include "vehicle_sim/apps/explanation.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace hlc::apps {
namespace {

using coordination::FallbackReason;
using coordination::PlanQuality;
using coordination::Report;
using coordination::StepStatus;

/// Ways that differ by less are alike.
constexpr double kStands_m = 1e-3;
/// The same of costs.
constexpr double kAlike_m2 = 1e-6;
/// Column of the values, behind a shorter key.
constexpr std::size_t kColumn = 16;

/// Why the plan in force stayed.
std::string reason_words(const Report& report) {
  const std::string by = report.blocked_by.empty()
                             ? ""
                             : " because of " + coordination::vehicles_text(report.blocked_by);
  switch (report.reason) {
    case FallbackReason::kInfeasible:
      return by.empty() ? "no other plan is possible in its lanes and within its limits"
                        : "no other plan is possible" + by;
    case FallbackReason::kBudget:
      return "the search exhausted its expansions before it found a plan";
    case FallbackReason::kMissing:
      return by.empty() ? "no message was received" : "messages are missing" + by;
    case FallbackReason::kConflict:
      return by.empty()
                 ? "the new plan would have drifted into something"
                 : "the new plan meets that of " + coordination::vehicles_text(report.blocked_by);
    case FallbackReason::kNeighbour:
      return "a vehicle that planned with it fell back" + by;
    case FallbackReason::kDeviation:
      return fmt::format("it is {:.0f} mm off its plan, or not seen", 1e3 * report.deviation_m);
    case FallbackReason::kLate:
      return "a deadline of the step had passed";
    case FallbackReason::kUndrivable:
      return "the vehicle could not follow the new plan";
    case FallbackReason::kOffRoute:
      return "it cannot get onto a route from where it stands";
    case FallbackReason::kNone:
      break;
  }
  return "no reason";
}

std::string plan_words(double ahead_m) {
  return ahead_m < kStands_m ? "a new plan: it stands"
                             : fmt::format("a new plan {:.2f} m ahead", ahead_m);
}

/// What it did, in a few words.
std::string outcome_words(const StepOutcome& outcome) {
  const Report& report = outcome.report;
  switch (report.status) {
    case StepStatus::kPlanned: {
      const std::string proof =
          report.quality == PlanQuality::kOptimal
              ? ", the best possible"
              : fmt::format(", at most {:.3g} m^2 above the best possible", report.gap_m2);
      return plan_words(outcome.ahead_m) + proof;
    }
    case StepStatus::kFallback:
      return fmt::format("kept its plan, {:.2f} m ahead: {}", outcome.ahead_m,
                         reason_words(report));
    case StepStatus::kMinimalRiskStop:
      return "drove its plan to the end: minimal-risk stop";
    case StepStatus::kStandby:
      break;
  }
  return report.reason == FallbackReason::kOffRoute ? "stood, off its route" : "stood by";
}

/// Whether it would have been the same in what counts.
bool is_alike(const StepOutcome& a, const StepOutcome& b) {
  return a.report.status == b.report.status && a.report.reason == b.report.reason &&
         a.report.blocked_by == b.report.blocked_by && std::abs(a.ahead_m - b.ahead_m) < kStands_m;
}

class Lines {
 public:
  void add(const std::string& key, const std::string& value) {
    text_ += fmt::format("{:<{}}{}\n", key, key.size() < kColumn ? kColumn : key.size() + 3, value);
  }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  std::string text_;
};

/// Whether the plan would have been the same in what counts.
bool is_alike(const StepOutcome& outcome, const ExplainedStep::Limit& limit) {
  if (!limit.ahead_m) return outcome.report.status != StepStatus::kPlanned;
  return limit.extra_m2 && std::abs(*limit.ahead_m - outcome.ahead_m) < kStands_m &&
         std::abs(*limit.extra_m2) < kAlike_m2;
}

std::string name_of(const ExplainedStep::Limit& limit) {
  return limit.vehicle ? fmt::format("the areas of {}", limit.vehicle->value) : limit.name;
}

std::string limit_words(const ExplainedStep::Limit& limit) {
  if (!limit.ahead_m) return "no plan";
  std::string words = plan_words(*limit.ahead_m);
  if (limit.extra_m2) words += fmt::format(", {:+.3g} m^2", *limit.extra_m2);
  return words;
}

std::string choice_words(const ExplainedStep::Choice& choice) {
  const std::string begin = "it begins with " + choice.first;
  return choice.next_best.empty() ? begin + "; no plan begins with another maneuver"
                                  : fmt::format("{}; next best: {}, {:+.3g} m^2", begin,
                                                choice.next_best, choice.extra_m2);
}

void add_what_it_knew(const ExplainedStep& explained, Lines& lines) {
  const Report& report = explained.outcome.report;
  if (explained.others.empty()) {
    lines.add("knew", "no other vehicle");
    return;
  }
  lines.add("knew",
            report.missing.empty()
                ? "messages of all others: " + coordination::vehicles_text(explained.others)
                : "nothing of " + coordination::vehicles_text(report.missing) + " in this step");
  if (report.coupled.empty()) {
    lines.add("", "none of them can come near within the horizon");
    return;
  }
  const std::string order =
      report.level == 0
          ? "planned before all of them"
          : fmt::format("planned on level {}, after those that plan before it", report.level);
  lines.add("", "may come near: " + coordination::vehicles_text(report.coupled) + "; " + order);
}

void add_alone(const ExplainedStep& explained, Lines& lines) {
  if (explained.without_all) {
    const StepOutcome& alone = explained.without_all->outcome;
    lines.add("alone", is_alike(explained.outcome, alone) ? "the same" : outcome_words(alone));
  } else if (explained.alone) {
    lines.add("alone", is_alike(explained.outcome, *explained.alone)
                           ? "the same"
                           : limit_words(*explained.alone));
  }
}

/// Vehicles that were gone in another drive; returns those that did not matter.
std::vector<int> add_without_vehicles(const ExplainedStep& explained, Lines& lines) {
  std::vector<int> alike;
  for (const ExplainedStep::Without& one : explained.without_one) {
    const int vehicle = one.gone.front().value;
    if (is_alike(explained.outcome, one.outcome)) {
      alike.push_back(vehicle);
    } else {
      lines.add(fmt::format("without {}", vehicle), outcome_words(one.outcome));
    }
  }
  return alike;
}

/// What did not matter is in one line. Of vehicles that is known of other drives, if there are any.
void add_without(const ExplainedStep& explained, Lines& lines) {
  std::vector<int> vehicles = add_without_vehicles(explained, lines);
  const bool is_driven = !explained.without_one.empty();
  std::vector<std::string> limits;
  for (const ExplainedStep::Limit& limit : explained.limits) {
    if (!is_alike(explained.outcome, limit)) {
      lines.add("without " + name_of(limit), limit_words(limit));
      if (!limit.note.empty()) lines.add("", limit.note);
    } else if (!limit.vehicle) {
      limits.push_back(limit.name);
    } else if (!is_driven) {
      vehicles.push_back(limit.vehicle->value);
    }
  }
  std::vector<std::string> alike;
  if (!vehicles.empty()) {
    alike.push_back(
        fmt::format("{}{}", is_driven ? "" : "the areas of ", fmt::join(vehicles, ", ")));
  }
  alike.insert(alike.end(), limits.begin(), limits.end());
  if (alike.empty()) return;
  lines.add("", fmt::format("the same without {}{}", fmt::join(alike, ", "),
                            vehicles.size() + limits.size() > 1 ? ", each alone" : ""));
}

}  // namespace

std::string explanation(const ExplainedStep& explained) {
  const Report& report = explained.outcome.report;
  Lines lines;
  lines.add(fmt::format("vehicle {}", report.vehicle.value),
            fmt::format("{}, step {} ({:.1f} s), subgraph {}", explained.name, explained.step,
                        explained.step_s * static_cast<double>(explained.step), report.subgraph));
  lines.add("did", outcome_words(explained.outcome));
  if (explained.choice) lines.add("", choice_words(*explained.choice));
  if (!report.waiting.vehicles.empty()) {
    lines.add("", coordination::waiting_text(report, explained.step_s));
  }
  add_what_it_knew(explained, lines);
  add_alone(explained, lines);
  add_without(explained, lines);
  return lines.text();
}

}  // namespace hlc::apps
