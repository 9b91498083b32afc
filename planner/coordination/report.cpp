#include "planner/coordination/report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace hlc::coordination {

const char* to_string(StepStatus status) {
  switch (status) {
    case StepStatus::kStandby:
      return "standby";
    case StepStatus::kPlanned:
      return "planned";
    case StepStatus::kFallback:
      return "fallback";
    case StepStatus::kMinimalRiskStop:
      return "minimal_risk_stop";
  }
  return "unknown";
}

const char* to_string(FallbackReason reason) {
  switch (reason) {
    case FallbackReason::kNone:
      return "none";
    case FallbackReason::kInfeasible:
      return "infeasible";
    case FallbackReason::kBudget:
      return "budget";
    case FallbackReason::kMissing:
      return "missing";
    case FallbackReason::kConflict:
      return "conflict";
    case FallbackReason::kNeighbour:
      return "neighbour";
    case FallbackReason::kDeviation:
      return "deviation";
    case FallbackReason::kLate:
      return "late";
    case FallbackReason::kUndrivable:
      return "undrivable";
    case FallbackReason::kOffRoute:
      return "off_route";
  }
  return "unknown";
}

const char* to_string(PlanQuality quality) {
  switch (quality) {
    case PlanQuality::kNone:
      return "none";
    case PlanQuality::kOptimal:
      return "optimal";
    case PlanQuality::kBudget:
      return "budget";
    case PlanQuality::kUnproven:
      return "unproven";
  }
  return "unknown";
}

std::string vehicles_text(const std::vector<VehicleId>& vehicles) {
  std::vector<int> numbers;
  for (const VehicleId id : vehicles) numbers.push_back(id.value);
  return fmt::format("{} {}", numbers.size() == 1 ? "vehicle" : "vehicles",
                     fmt::join(numbers, ", "));
}

}  // namespace hlc::coordination
