#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "planner/coordination/report.hpp"

namespace hlc::coordination {

/// How far the new plans of a step may be from the best ones that the vehicles could have made
/// together in this step.
///
/// Let V be a component of the coupling graph in step k. Call new plans, one for each vehicle of V,
/// permitted if no two of them meet and each solves its vehicle's problem without the others' new
/// plans: it keeps clear of the plans that all drive (under `strict`), of vehicles that are
/// missing, of the boundary and of the end of its right of way. The joint optimum is the least sum
/// of costs of permitted plans. Each of these costs at least the optimum of its vehicle's problem,
/// b_i, or any lower bound of it (Report::bound_m2):
///
///     sum_{i in V} b_i  <=  joint optimum  <=  sum_{i in V} c_i
///
/// with c_i the costs of the plans that came into force (Report::cost_m2), which are permitted. If
/// both sums are equal these plans are the joint optimum.
///
/// What the step takes as given is not judged: the plans that all drive, who has right of way, and
/// the reference of a vehicle that is held up, which ends where it can get to. So the gap is what
/// the *order of planning* in this step may cost, not what waiting costs. Limits of the vehicle and
/// its drift are no part of the bound's problem, which makes the bound smaller only.
struct JointGap {
  std::vector<VehicleId> vehicles;  ///< of the component, sorted; two or more
  /// Every bound is known, and all have received each other; otherwise c and b are 0.
  bool is_known{};
  double cost_m2{};   ///< c = sum of the costs
  double bound_m2{};  ///< b = sum of the bounds

  /// c is the joint optimum, up to rounding. @pre is_known
  [[nodiscard]] bool is_closed() const { return cost_m2 <= bound_m2 + kRounding_m2; }
  /// The plans cost at most so much more than the joint optimum: c / b - 1; infinite if b = 0 < c.
  /// @pre is_known
  [[nodiscard]] double excess() const;

  static constexpr double kRounding_m2 = 1e-9;
};

/// "4.2 %"; "any amount" from 10 000 % on, where the bound is hardly more than rounding.
[[nodiscard]] std::string excess_text(double excess);

/// "the joint optimum of 3 vehicles", "at most 4.2 % above the joint optimum of 3 vehicles"; how
/// far is not known, "at an unknown distance from ...".
[[nodiscard]] std::string text_of(const JointGap& gap);

/// Of every component of two or more vehicles, by its smallest one.
/// @param reports  of one step, in any order; a coupled vehicle without a report has found no plan
[[nodiscard]] std::vector<JointGap> joint_gaps(std::span<const Report* const> reports);

/// The gaps of many steps.
struct JointGapFigures {
  std::size_t known{};    ///< components whose gap is known
  std::size_t unknown{};  ///< other ones
  std::size_t closed{};   ///< of the known ones: their plans are the joint optimum
  /// Of the known ones, JointGap::excess: the median, and what 99 of 100 do not exceed.
  double median{};
  double p99{};
  /// Of all known ones together: sum of the costs / sum of the bounds - 1.
  double total{};
};

/// Nothing if no gap is known.
[[nodiscard]] std::optional<JointGapFigures> joint_gap_figures(std::span<const JointGap> gaps);

/// "the joint optimum in 93.1 % of 450 cases, at most 31 % above it in 99 %, 0.4 % in all together"
[[nodiscard]] std::string text_of(const JointGapFigures& figures);

}  // namespace hlc::coordination
