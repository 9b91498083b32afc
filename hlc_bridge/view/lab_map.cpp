#include "hlc_bridge/view/lab_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

namespace hlc::view {
namespace {

// Above the ids that the lab's own programs use for drawing.
constexpr std::uint64_t kFirstId = 0x484c'4300'0000;

constexpr DrawingColor kGoodColor{.red = 0, .green = 130, .blue = 60};
constexpr DrawingColor kFallbackColor{.red = 200, .green = 30, .blue = 30};
constexpr DrawingColor kReferenceColor{.red = 128, .green = 128, .blue = 128};

constexpr double kPlanWidth_m = 0.02;
constexpr double kReferenceWidth_m = 0.01;
constexpr double kTextHeight_m = 0.07;
constexpr double kTextDistance_m = 0.15;  // above the vehicle's centre

enum class Item : std::uint8_t { kPlan, kReference, kState };

std::uint64_t id_of(VehicleId vehicle, Item item) {
  return kFirstId + 16U * vehicle.value + static_cast<std::uint64_t>(item);
}

std::vector<Point> path_of(const coordination::Plan& plan, StepIndex from,
                           const automaton::UniversalAutomaton& automaton) {
  constexpr int kPointsPerStep = 4;
  std::vector<Point> points_m;
  for (StepIndex step = from; step < plan.end(); step = {step.value + 1}) {
    for (int i = 0; i < kPointsPerStep; ++i) {
      const double time_s = automaton.step_s * i / kPointsPerStep;
      points_m.push_back(plan.state_at(step, time_s, automaton.vehicle).pose.position_m());
    }
  }
  points_m.push_back(plan.pose_at(std::max(from, plan.end())).position_m());
  return points_m;
}

std::string text_of(const coordination::Report& report) {
  std::string text =
      fmt::format("{}: {}", report.vehicle.value, coordination::to_string(report.status));
  if (report.reason != coordination::FallbackReason::kNone) {
    text += fmt::format(" ({})", coordination::to_string(report.reason));
  }
  return text;
}

}  // namespace

std::vector<Visualization> lab_map(const controller::Controller& controller,
                                   const coordination::Report& report, Nanoseconds time_to_live) {
  std::vector<Visualization> drawings;
  const DrawingColor color =
      report.status == coordination::StepStatus::kFallback ? kFallbackColor : kGoodColor;
  const auto add = [&](Item item, DrawingKind kind, std::vector<Point> points_m, double size_m,
                       const DrawingColor& in_color) -> Visualization& {
    return drawings.emplace_back(Visualization{.id = id_of(report.vehicle, item),
                                               .kind = kind,
                                               .time_to_live = time_to_live,
                                               .points_m = std::move(points_m),
                                               .size_m = size_m,
                                               .text = {},
                                               .anchor = TextAnchor::kBottomCenter,
                                               .color = in_color});
  };
  if (!controller.problems().empty()) {
    add(Item::kReference, DrawingKind::kLineStrips,
        controller.problems().back().problem.reference_m, kReferenceWidth_m, kReferenceColor);
  }
  if (!controller.has_plan()) return drawings;
  std::vector<Point> path_m =
      path_of(controller.plan_in_force(), report.step, controller.subgraph().automaton());
  const Point beside_m = path_m.front() + Point{0.0, kTextDistance_m};
  add(Item::kPlan, DrawingKind::kLineStrips, std::move(path_m), kPlanWidth_m, color);
  add(Item::kState, DrawingKind::kText, {beside_m}, kTextHeight_m, color).text = text_of(report);
  return drawings;
}

}  // namespace hlc::view
