#include "planner/road/reference_points.hpp"

#include <algorithm>
#include <array>

#include "planner/common/demand.hpp"

namespace hlc::road {

std::vector<double> half_speed_last(double /*current_speed_mps*/, double reference_speed_mps,
                                    std::size_t horizon_steps) {
  std::vector<double> speeds_mps(horizon_steps, reference_speed_mps);
  speeds_mps.back() = reference_speed_mps / 2.0;
  return speeds_mps;
}

std::vector<double> mean_speed_first(double current_speed_mps, double reference_speed_mps,
                                     std::size_t horizon_steps) {
  std::vector<double> speeds_mps(horizon_steps, reference_speed_mps);
  speeds_mps.front() = (current_speed_mps + reference_speed_mps) / 2.0;
  return speeds_mps;
}

std::span<const NamedReferenceRule> reference_rules() {
  static constexpr std::array kAll{
      NamedReferenceRule{.name = "half_speed_last", .rule = &half_speed_last},
      NamedReferenceRule{.name = "mean_speed_first", .rule = &mean_speed_first}};
  return kAll;
}

ReferenceRule reference_rule(std::string_view name) {
  const auto found = std::ranges::find(reference_rules(), name, &NamedReferenceRule::name);
  return found == reference_rules().end() ? nullptr : found->rule;
}

std::string_view name_of(ReferenceRule rule) {
  const auto found = std::ranges::find(reference_rules(), rule, &NamedReferenceRule::rule);
  return found == reference_rules().end() ? "other" : found->name;
}

Reference reference_points(const ReferencePath& path, double start_s_m, double current_speed_mps,
                           double reference_speed_mps, std::size_t horizon_steps, double step_s,
                           ReferenceRule rule, std::span<const SpeedSection> sections) {
  HLC_DEMAND(horizon_steps >= 1 && step_s > 0.0 && reference_speed_mps >= 0.0, horizon_steps,
             step_s, reference_speed_mps);
  Reference reference{.speeds_mps = rule(current_speed_mps, reference_speed_mps, horizon_steps)};
  reference.points_m.reserve(horizon_steps);
  reference.s_m.reserve(horizon_steps);
  double s_m = start_s_m;
  for (std::size_t j = 0; j < horizon_steps; ++j) {
    double& speed_mps = reference.speeds_mps[j];
    const double unlimited_m = reference_speed_mps * step_s;
    if (!sections.empty() && unlimited_m > 0.0) {
      const double section_mps =
          least_speed_mps(sections, path, s_m, s_m + unlimited_m, reference_speed_mps);
      speed_mps = rule(current_speed_mps, section_mps, horizon_steps)[j];
    }
    s_m += speed_mps * step_s;
    reference.points_m.push_back(path.at(s_m));
    reference.s_m.push_back(s_m);
  }
  return reference;
}

Reference reference_on(const DrivingLine& line, const ReferencePath& path, Reference on_path,
                       double end_s_m) {
  for (std::size_t j = 0; j < on_path.s_m.size(); ++j) {
    if (on_path.s_m[j] > end_s_m) {
      on_path.s_m[j] = end_s_m;
      on_path.speeds_mps[j] = 0.0;
    }
    on_path.points_m[j] = line.at(path, on_path.s_m[j]);
  }
  return on_path;
}

}  // namespace hlc::road
