#include "planner/search/search_options.hpp"

#include <fmt/format.h>

#include <array>
#include <stdexcept>

namespace hlc::search {
namespace {

template <class Enum, std::size_t n>
Enum from_name(const std::string& name, const std::array<Enum, n>& all, const char* what,
               const char* allowed) {
  for (const Enum value : all) {
    if (name == to_string(value)) return value;
  }
  throw std::invalid_argument(fmt::format("{} = {}, must be one of {}", what, name, allowed));
}

}  // namespace

const char* to_string(Engine engine) {
  switch (engine) {
    case Engine::kBranchAndBound:
      return "branch_and_bound";
    case Engine::kBestFirst:
      return "best_first";
  }
  return "unknown";
}

const char* to_string(CostToGo cost_to_go) {
  switch (cost_to_go) {
    case CostToGo::kReachable:
      return "reachable";
    case CostToGo::kStraightLine:
      return "straight_line";
    case CostToGo::kReferenceSpeed:
      return "2022";
  }
  return "unknown";
}

const char* to_string(SearchStatus status) {
  switch (status) {
    case SearchStatus::kOptimal:
      return "optimal";
    case SearchStatus::kBudget:
      return "budget";
    case SearchStatus::kUnproven:
      return "unproven";
    case SearchStatus::kFallback:
      return "fallback";
  }
  return "unknown";
}

const char* to_string(NoPath reason) {
  switch (reason) {
    case NoPath::kNone:
      return "none";
    case NoPath::kInfeasible:
      return "infeasible";
    case NoPath::kBudget:
      return "budget";
  }
  return "unknown";
}

bool is_admissible(CostToGo cost_to_go) { return cost_to_go != CostToGo::kReferenceSpeed; }

bool needs_reference_speeds(CostToGo cost_to_go) { return cost_to_go == CostToGo::kReferenceSpeed; }

Engine engine_from_name(const std::string& name) {
  return from_name(name, std::array{Engine::kBranchAndBound, Engine::kBestFirst}, "engine",
                   kEngineNames);
}

CostToGo cost_to_go_from_name(const std::string& name) {
  return from_name(
      name, std::array{CostToGo::kReachable, CostToGo::kStraightLine, CostToGo::kReferenceSpeed},
      "cost_to_go", kCostToGoNames);
}

void check_search_options(const SearchOptions& options) {
  if (options.engine == Engine::kBranchAndBound && options.cost_to_go != CostToGo::kReachable) {
    throw std::invalid_argument(
        fmt::format("engine = {} with cost-to-go {}, requires cost-to-go reachable; any other "
                    "requires best_first",
                    to_string(options.engine), to_string(options.cost_to_go)));
  }
  if (options.max_expansions == 0) {
    throw std::invalid_argument("max_expansions = 0, must be >= 1");
  }
}

}  // namespace hlc::search
