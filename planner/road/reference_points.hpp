#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "planner/road/driving_line.hpp"
#include "planner/road/reference_path.hpp"
#include "planner/road/speed_sections.hpp"

namespace hlc::road {

/// Spacing of a plan's reference points: the speed of each of the `horizon_steps` steps [m/s]. A
/// rule is one function; scenario or profile choose it.
/// @pre horizon_steps >= 1
using ReferenceRule = std::vector<double> (*)(double current_speed_mps, double reference_speed_mps,
                                              std::size_t horizon_steps);

/// The reference speed, and half of it in the last step, independent of the current speed. The rule
/// that produced the paper's numbers.
[[nodiscard]] std::vector<double> half_speed_last(double current_speed_mps,
                                                  double reference_speed_mps,
                                                  std::size_t horizon_steps);

/// The mean of current and reference speed in the first step, then the reference speed.
[[nodiscard]] std::vector<double> mean_speed_first(double current_speed_mps,
                                                   double reference_speed_mps,
                                                   std::size_t horizon_steps);

struct NamedReferenceRule {
  std::string_view name;
  ReferenceRule rule;
};
/// All, by the names of their functions. A further rule is one more entry.
[[nodiscard]] std::span<const NamedReferenceRule> reference_rules();
/// nullptr: there is none of this name.
[[nodiscard]] ReferenceRule reference_rule(std::string_view name);
/// "other" if it is none of reference_rules().
[[nodiscard]] std::string_view name_of(ReferenceRule rule);

/// Reference of one plan: r_1 ... r_n, their arc lengths and the speed of each step.
struct Reference {
  std::vector<Point> points_m;
  std::vector<double> s_m;
  std::vector<double> speeds_mps;
};

/// Points on the path, marched from arc length `start_s_m` by speed * step_s per step. A step that
/// would pass sections of the path has the speed that the rule gives it for the slowest of them: so
/// the reference is slow before it enters one.
/// @pre horizon_steps >= 1, step_s > 0, reference_speed_mps >= 0
[[nodiscard]] Reference reference_points(const ReferencePath& path, double start_s_m,
                                         double current_speed_mps, double reference_speed_mps,
                                         std::size_t horizon_steps, double step_s,
                                         ReferenceRule rule,
                                         std::span<const SpeedSection> sections = {});

/// The same not beyond `end_s_m`, and on the driving line beside the path.
[[nodiscard]] Reference reference_on(const DrivingLine& line, const ReferencePath& path,
                                     Reference on_path, double end_s_m);

}  // namespace hlc::road
