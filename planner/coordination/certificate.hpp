#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "planner/coordination/messages.hpp"
#include "planner/geometry/footprint.hpp"
#include "planner/geometry/separating_line.hpp"

/// What proves a vehicle's plan safe, as plain geometry: checked without an automaton, a map, or
/// any code of the planner (launch_scripts/check_run.py).
namespace hlc::coordination {

/// What was known of the other vehicle when the plan was decided on.
enum class KnownMotion : std::uint8_t {
  kRunning,    ///< its plan in force as the step began, as its traffic announced it
  kNew,        ///< its new plan of this step
  kReachable,  ///< no new plan of it was received: all that it can reach
  kMissing,    ///< no traffic: all that it can reach from where it was seen; or, if it stands for
               ///< good, its standing footprint
};

[[nodiscard]] const char* to_string(KnownMotion known);

/// The own areas and all that was known of another vehicle lie on different sides of these lines.
struct Separation {
  VehicleId from;
  KnownMotion known{KnownMotion::kRunning};
  /// lines[j] during step k+1+j, until the horizon ends: the own area touches it from behind.
  std::vector<SeparatingLine> lines;
  friend bool operator==(const Separation&, const Separation&) = default;
};

/// Of the plan in force as step k ends.
///
/// Let A_i be the areas of vehicle i. For two coupled vehicles i and j, one of the certificates of
/// step k has a line for every step from k+1 on with A_i behind and A_j beyond it: whoever put a
/// new plan in force has lines against the other's running and new plan (commit.hpp); if none did,
/// both have lines against the running ones. The exceptions are a vehicle whose areas nobody has
/// agreed to, and two that have kept their plans since before they were coupled: if one was missing
/// then, the other kept clear of where it was seen standing, which may be beside its areas.
struct Certificate {
  Footprint footprint;  ///< of the vehicle, without margin
  OccupiedAreas areas;  ///< first = k; the plan ends standing in its final area
  /// The others agreed to the areas, or have been able to keep clear of them: false from the step
  /// in which the vehicle was off its plan or not seen (plan_in_force.hpp, rules 4 and 5), or its
  /// controller began, until a new plan comes into force. While it is true and the plan stays in
  /// force, its areas are the former ones without the first.
  bool is_agreed{};
  std::vector<Separation> separations;  ///< only those with a line for every step of the horizon
};

/// Areas that overlap by less count as separate: the final area of a plan may lie 2 um outside its
/// last one, of which the others keep clear (Plan::areas_from).
inline constexpr double kSeparationTolerance_m = 1e-5;

/// The lines between own areas from t(from) on and `others_m[j]` during step from + j; none if one
/// of them does not exist. @pre own.first <= from
[[nodiscard]] std::optional<std::vector<SeparatingLine>> separating_lines(
    const OccupiedAreas& own, StepIndex from, const std::vector<const ConvexPolygon*>& others_m);

}  // namespace hlc::coordination
