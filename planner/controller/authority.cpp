#include "planner/controller/authority.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "planner/geometry/footprint.hpp"
#include "planner/road/reference_path.hpp"

namespace hlc::controller {
namespace {

// Lengths for the µCar, for others ConflictMap::scale times as long.

/// About as far as a plan of a horizon leads at the lab's reference speed, since it ends in a
/// standstill. What is taken earlier than it is needed keeps others away: with 1.6 m twenty cars
/// are slower by 3 % on the lab's road.
constexpr double kLookAhead_m = 1.0;
/// A vehicle that moves less in a step stands.
constexpr double kStands_m = 0.002;
/// Room between the front of a vehicle that stands at the end and the bar, for its heading.
constexpr double kBehindEnd_m = 0.020;
constexpr double kBarLength_m = 0.010;
/// By how much the bar is wider than the footprint, in all.
constexpr double kBarWider_m = 0.023;
constexpr double kHalfChord_m = 0.02;

/// Whether a vehicle that holds its route up to `held_m` from its place gives back, behind
/// `kept_m`, a cell that vehicles of other lanes need.
bool gives_back_conflict_cell(const right_of_way::ConflictMap& map, std::uint32_t route,
                              double place_m, double kept_m, double held_m) {
  const std::int64_t last = map.count_at(route, place_m + held_m);
  for (std::int64_t cell = map.count_at(route, place_m + kept_m) + 1; cell <= last; ++cell) {
    if (map.is_conflict(route, map.index_of(route, cell))) return true;
  }
  return false;
}

}  // namespace

Authority::Authority(std::shared_ptr<const right_of_way::ConflictMap> map,
                     const right_of_way::GrantOrder& order)
    : map_(std::move(map)), order_(&order) {}

void Authority::begin_step(const coordination::Plan& in_force, StepIndex now,
                           const RouteTracker& tracker, double reach_m) {
  const std::uint32_t route = tracker.route().number;
  const double length_m = map_->length_m(route);
  const auto counted_on = [length_m](double s_m, double from_m) {
    return s_m + std::round((from_m - s_m) / length_m) * length_m;
  };
  const double place_m = tracker.project(in_force.pose_at(now).position_m(), reach_m);
  const double plans_m =
      counted_on(tracker.project(in_force.pose_at(in_force.end()).position_m(), reach_m), place_m) -
      place_m;
  const double from_former_m = std::remainder(place_m - claim_.place_m, length_m);
  const bool is_continued =
      has_place_ && claim_.route == route && std::abs(from_former_m) <= reach_m;
  const double moved_m = is_continued ? from_former_m : 0.0;
  const double held_m = is_continued ? claim_.ahead_m - moved_m : 0.0;
  const bool stands = is_continued && std::abs(moved_m) < map_->scale() * kStands_m;
  const double kept_m = std::max(plans_m, 0.0);
  const bool is_unused = stands && held_m > kept_m + map_->cell_m(route);
  unused_steps_ = is_unused ? unused_steps_ + 1 : 0;
  const bool gives_back = unused_steps_ == kPatience_steps;
  if (gives_back) unused_steps_ = 0;
  const bool waits_again =
      taken_.declines ||
      (gives_back && gives_back_conflict_cell(*map_, route, place_m, kept_m, held_m));
  claim_ = {.route = route,
            .place_m = place_m,
            .ahead_m = gives_back ? kept_m : std::max(held_m, kept_m),
            .waiting_steps = stands && !waits_again ? claim_.waiting_steps + 1 : 0};
  now_ = now;
  has_place_ = true;
  granted_.clear();
  holders_.clear();
  taken_ = {};
  is_limited_ = false;
}

void Authority::receive(std::span<const coordination::Traffic* const> others) {
  for (const coordination::Traffic* other : others) known_[other->vehicle] = {*other->claim, now_};
}

void Authority::extend(VehicleId own, std::span<const coordination::Traffic* const> others,
                       std::span<const VehicleId> missing,
                       std::span<const right_of_way::Blocked> blocked, double step_m,
                       SharedStep& shared) {
  std::vector<right_of_way::Holder> received{{own, claim_}};
  for (const coordination::Traffic* other : others) {
    received.push_back({other->vehicle, *other->claim});
  }
  std::vector<right_of_way::Missing> assumed;
  granted_ = received;
  for (const VehicleId other : missing) {
    const Known& known = known_.at(other);
    const std::uint64_t steps = now_.value - known.step.value;
    right_of_way::Missing one{.last = {other, known.claim},
                              .moved_m = step_m * static_cast<double>(steps)};
    std::uint32_t& waiting_steps = one.last.claim.waiting_steps;
    if (waiting_steps > 0) waiting_steps += static_cast<std::uint32_t>(steps);
    granted_.push_back(one.last);
    assumed.push_back(one);
  }
  std::ranges::sort(granted_, {}, &right_of_way::Holder::vehicle);  // as every other vehicle does
  const double look_ahead_m = map_->scale() * kLookAhead_m;
  const std::vector<right_of_way::Holder> before = granted_;
  const std::vector<right_of_way::Taken>& taken =
      shared.taken(*map_, before, blocked, look_ahead_m, *order_);
  for (std::size_t i = 0; i < granted_.size(); ++i) {
    granted_[i].claim.ahead_m = taken[i].ahead_m;
    if (granted_[i].vehicle == own) taken_ = taken[i];
  }
  std::optional<std::vector<right_of_way::Holder>> cautious;
  if (!assumed.empty()) {
    cautious = right_of_way::cautious_grant(*map_, received, assumed, blocked, look_ahead_m, own);
  }
  const bool is_cautious = cautious.has_value();
  holders_ = cautious ? *std::move(cautious) : granted_;
  own_place_ = static_cast<std::size_t>(
      std::ranges::find(holders_, own, &right_of_way::Holder::vehicle) - holders_.begin());
  if (is_cautious) decline(own, before, blocked);
  claim_.ahead_m = holders_[own_place_].claim.ahead_m;
  is_limited_ = claim_.ahead_m + map_->cell_m(claim_.route) <= look_ahead_m;
  blocked_.assign(blocked.begin(), blocked.end());
}

/// What leave_a_way_on takes from this vehicle if nobody else takes anything.
void Authority::decline(VehicleId own, const std::vector<right_of_way::Holder>& before,
                        std::span<const right_of_way::Blocked> blocked) {
  double& own_ahead_m = holders_[own_place_].claim.ahead_m;
  std::vector<double> ahead_m;
  std::size_t who = 0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    if (before[i].vehicle == own) who = i;
    ahead_m.push_back(before[i].vehicle == own ? own_ahead_m : before[i].claim.ahead_m);
  }
  taken_ = right_of_way::leave_a_way_on(*map_, before, ahead_m, blocked, *order_)[who];
  own_ahead_m = taken_.ahead_m;
}

std::vector<VehicleId> Authority::withheld_by() const {
  if (!is_limited_) return {};
  if (taken_.declines || taken_.kept_out_for) {
    std::vector<VehicleId> others = taken_.declined_for;
    const std::optional<VehicleId>& one = taken_.kept_out_for;
    if (one && std::ranges::find(others, *one) == others.end()) others.push_back(*one);
    return others;
  }
  return right_of_way::withheld_by(*map_, holders_, blocked_, own_place_);
}

void Authority::resume(const coordination::LaneClaim& claim, VehicleId vehicle,
                       const Authority& receiver) {
  claim_ = claim;
  is_limited_ = false;
  const auto granted =
      std::ranges::find(receiver.granted_, vehicle, &right_of_way::Holder::vehicle);
  if (granted != receiver.granted_.end()) claim_.ahead_m = granted->claim.ahead_m;
}

double Authority::end_s_m(double s_m) const {
  const double moved_m = std::remainder(s_m - claim_.place_m, map_->length_m(claim_.route));
  return s_m + std::max(0.0, claim_.ahead_m - moved_m);
}

bool Authority::reaches(double at_s_m, double s_m) const {
  const double moved_m = std::remainder(s_m - claim_.place_m, map_->length_m(claim_.route));
  const double from_m = claim_.place_m + moved_m;
  return map_->count_at(claim_.route, from_m + at_s_m - s_m) <=
         map_->count_at(claim_.route, from_m + end_s_m(s_m) - s_m);
}

ConvexPolygon Authority::bar_m(const RouteTracker& tracker, const Footprint& footprint) const {
  const road::ReferencePath& path = tracker.route().path;
  const double scale = map_->scale();
  const double s_m = claim_.place_m + claim_.ahead_m + footprint.length_m / 2.0 +
                     scale * kBehindEnd_m + scale * kBarLength_m / 2.0;
  const Point centre_m = path.at(s_m);
  return footprint_area(
      {scale * kBarLength_m, footprint.width_m + scale * kBarWider_m},
      {centre_m.x(), centre_m.y(), road::chord_heading_rad(path, s_m, scale * kHalfChord_m)});
}

}  // namespace hlc::controller
