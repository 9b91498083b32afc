#pragma once

#include <string>

namespace hlc {

/// Value of one criterion, over a motion or, as a unit cost, per second.
struct CriterionValue {
  std::string name;  ///< see planner/maneuver_design/criteria.hpp
  double value{};
  friend bool operator==(const CriterionValue&, const CriterionValue&) = default;
};

/// Share of a criterion in a weighted sum.
struct CriterionWeight {
  std::string criterion;  ///< see planner/maneuver_design/criteria.hpp
  double weight{};
  friend bool operator==(const CriterionWeight&, const CriterionWeight&) = default;
};

}  // namespace hlc
