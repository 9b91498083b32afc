#include "planner/controller/drift.hpp"

#include <algorithm>
#include <cmath>

#include "planner/automaton/deviation.hpp"
#include "planner/vehicle/identified_motion.hpp"

namespace hlc::controller {
namespace {

constexpr double kCorrection_per_s = 5.0;
constexpr double kStandingSpeed_mps = 1e-3;
/// After the end of a plan, until the vehicle rests: its error along the path has decayed to
/// exp(-5).
constexpr double kToRest_s = 1.0;

/// Time along a plan, in ticks of the identified model.
struct Instant {
  StepIndex step;
  double time_s{};

  [[nodiscard]] Instant next(double step_s) const {
    const double t = time_s + vehicle::kIdentifiedStep_s;
    return t < step_s - 1e-9 ? Instant{step, t} : Instant{{step.value + 1}, t - step_s};
  }
};

struct Driven {
  Pose pose;
  double steering{};
};

/// One tick of a vehicle at `at`, planned to move from `from` to `to` in it.
Driven driven(const Driven& at, const Point& from, const Point& to,
              const vehicle::IdentifiedVehicle& identified) {
  const Point chord = (to - from) / vehicle::kIdentifiedStep_s;
  const Point error = from - at.pose.position_m();
  double speed_mps = chord.norm();
  double steering = at.steering;
  if (speed_mps > kStandingSpeed_mps) {
    const Point along = chord / speed_mps;
    const double across_m = along.x() * error.y() - along.y() * error.x();
    const double course_rad =
        std::atan2(chord.y(), chord.x()) + std::atan2(kCorrection_per_s * across_m, speed_mps);
    const double slip_rad = wrap_angle(course_rad - at.pose.heading_rad);
    steering = vehicle::actuated({.steering = vehicle::steering_for_slip(slip_rad, identified)},
                                 {.steering = at.steering}, identified)
                   .steering;
    speed_mps += kCorrection_per_s * along.dot(error);
  } else {
    const double course_rad =
        at.pose.heading_rad + vehicle::identified_slip_rad(steering, identified);
    speed_mps = kCorrection_per_s * Point(std::cos(course_rad), std::sin(course_rad)).dot(error);
  }
  const vehicle::VehicleMotion motion{
      .pose = at.pose,
      .speed_mps = std::max(0.0, speed_mps) / vehicle::path_speed_ratio(steering, identified)};
  return {vehicle::stepped(motion, {.throttle = 0.0, .steering = steering}, identified).pose,
          steering};
}

/// Where the servo is at first: known only of one that needs time to turn, which is where the plan
/// has it. Any other takes what the first tick asks for.
double first_steering(const vehicle::State& planned,
                      const automaton::UniversalAutomaton& automaton) {
  if (!automaton.identified.steering_rate_per_s) return 0.0;
  return vehicle::steady_servo(vehicle::curvature_per_m(planned.steering_rad, automaton.vehicle),
                               automaton.identified);
}

}  // namespace

SeenAt seen_at(const coordination::MeasuredVehicle& measured, StepIndex now, double step_s) {
  constexpr double kBeforeNext_s = 1e-9;
  const double ago_s = std::clamp(measured.age_s - measured.pose_lead_s, kBeforeNext_s - step_s,
                                  static_cast<double>(now.value) * step_s);
  const double steps_back = std::ceil(ago_s / step_s);
  return {.step = {now.value - static_cast<std::uint64_t>(steps_back)},
          .time_s = steps_back * step_s - ago_s,
          .pose = measured.pose};
}

std::vector<PredictedInstant> predicted_drive(const coordination::Plan& plan, const SeenAt& seen,
                                              StepIndex until,
                                              const automaton::UniversalAutomaton& automaton) {
  const vehicle::VehicleParameters& vehicle = automaton.vehicle;
  std::vector<PredictedInstant> drive;
  Instant at{seen.step, seen.time_s};
  vehicle::State planned = plan.state_at(at.step, at.time_s, vehicle);
  Driven vehicle_at{.pose = seen.pose, .steering = first_steering(planned, automaton)};
  drive.push_back({at.step, planned, vehicle_at.pose});
  while (at.step < until) {
    const Instant then = at.next(automaton.step_s);
    const vehicle::State planned_then =  // standing, it stays as it is
        at.step < plan.end() ? plan.state_at(then.step, then.time_s, vehicle) : planned;
    vehicle_at = driven(vehicle_at, planned.pose.position_m(), planned_then.pose.position_m(),
                        automaton.identified);
    if (then.step != at.step) drive.push_back({at.step, planned_then, vehicle_at.pose});
    drive.push_back({then.step, planned_then, vehicle_at.pose});
    at = then;
    planned = planned_then;
  }
  return drive;
}

coordination::OccupiedAreas areas_with_drift(const coordination::Plan& plan, StepIndex from,
                                             const SeenAt& seen,
                                             const automaton::UniversalAutomaton& automaton,
                                             double tolerated_m) {
  const vehicle::VehicleParameters& vehicle = automaton.vehicle;
  coordination::OccupiedAreas areas = plan.areas_from(from);
  const auto to_rest = static_cast<std::uint64_t>(std::ceil(kToRest_s / automaton.step_s - 1e-9));
  const std::vector<PredictedInstant> drive =
      predicted_drive(plan, seen, {std::max(plan.end(), from).value + to_rest}, automaton);
  bool drifts_at_end = false;
  for (auto begin = drive.begin(); begin != drive.end();) {
    const StepIndex step = begin->step;
    const auto end = std::find_if(begin, drive.end(), [step](const PredictedInstant& instant) {
      return instant.step != step;
    });
    const bool drifts =
        step >= from && std::any_of(begin, end, [&](const PredictedInstant& instant) {
          return automaton::deviates(instant.pose, instant.planned, tolerated_m, vehicle,
                                     automaton.identified);
        });
    if (drifts) {
      const std::size_t i = step.value - from.value;
      ConvexPolygon& area = i < areas.areas_m.size() ? areas.areas_m[i] : areas.final_area_m;
      std::vector<ConvexPolygon> covered{area};
      for (auto instant = begin; instant != end; ++instant) {
        covered.push_back(
            footprint_area(vehicle.footprint, instant->pose, vehicle.safety_margin_m));
      }
      area = convex_hull(covered);
      drifts_at_end |= i >= areas.areas_m.size();
    }
    begin = end;
  }
  if (drifts_at_end && !areas.areas_m.empty()) {
    areas.areas_m.back() = convex_hull(std::vector{areas.areas_m.back(), areas.final_area_m});
  }
  return areas;
}

}  // namespace hlc::controller
