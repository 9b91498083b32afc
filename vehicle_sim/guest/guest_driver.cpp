#include "vehicle_sim/guest/guest_driver.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "planner/common/random_index.hpp"
#include "planner/geometry/pose.hpp"

namespace hlc::guest {
namespace {

/// Ahead of its time on a track.
constexpr double kLookAhead_s = 0.4;
/// Nearer than this to where it wants to be it has arrived.
constexpr double kArrived_m = 0.15;
constexpr double kLongestWay_s = 4.0;
constexpr double kLongestStop_s = 3.0;
constexpr double kStopShare = 0.2;
constexpr double kLeastSpeedShare = 0.2;

Point along(const std::vector<TimedPoint>& track, double t_s) {
  const auto after = std::ranges::upper_bound(track, t_s, {}, &TimedPoint::time_s);
  if (after == track.begin()) return track.front().position_m;
  if (after == track.end()) return track.back().position_m;
  const TimedPoint& from = *std::prev(after);
  const double share = (t_s - from.time_s) / (after->time_s - from.time_s);
  return from.position_m + share * (after->position_m - from.position_m);
}

/// Of the arc from a pose to a point; to one behind it as tight as can be.
double arc_curvature_per_m(const Pose& pose, const Point& towards_m) {
  constexpr double kTight_per_m = 1e3;
  const Point ahead(std::cos(pose.heading_rad), std::sin(pose.heading_rad));
  const Point offset_m = towards_m - pose.position_m();
  const double left_m = ahead.x() * offset_m.y() - ahead.y() * offset_m.x();
  if (ahead.dot(offset_m) < 0.0) return std::copysign(kTight_per_m, left_m);
  return 2.0 * left_m / std::max(offset_m.squaredNorm(), 1e-6);
}

}  // namespace

GuestDriver::GuestDriver(GuestDriverOptions options)
    : options_(std::move(options)),
      random_(options_.seed),
      commands_(options_.vehicle, options_.limits) {}

DriverCommand GuestDriver::tick(Nanoseconds t_now, const vehicle::VehicleMotion& motion) {
  if (!begin_) begin_ = t_now;
  const double t_s = 1e-9 * static_cast<double>(t_now - *begin_);
  const Aim aim = this->aim(t_s, motion.pose.position_m());
  return commands_.tick(t_now, aim.speed_mps, arc_curvature_per_m(motion.pose, aim.towards_m));
}

GuestDriver::Aim GuestDriver::aim(double t_s, const Point& position_m) {
  return options_.track.empty() ? wandering(t_s, position_m) : on_track(t_s, position_m);
}

GuestDriver::Aim GuestDriver::on_track(double t_s, const Point& position_m) const {
  const Point towards_m = along(options_.track, t_s + kLookAhead_s);
  const double distance_m = (towards_m - position_m).norm();
  const bool is_over = t_s >= options_.track.back().time_s;
  if (is_over && distance_m <= kArrived_m) return {.towards_m = towards_m, .speed_mps = 0.0};
  return {.towards_m = towards_m, .speed_mps = distance_m / kLookAhead_s};
}

GuestDriver::Aim GuestDriver::wandering(double t_s, const Point& position_m) {
  const bool is_there = (wandering_to_.towards_m - position_m).norm() <= kArrived_m;
  const bool stands = wandering_to_.speed_mps == 0.0;
  if (t_s < wanders_until_s_ && (stands || !is_there)) return wandering_to_;
  const Point size_m = options_.home_m.max_m - options_.home_m.min_m;
  const Point place(share(), share());
  wandering_to_.towards_m = options_.home_m.min_m + place.cwiseProduct(size_m);
  const double speed_share = kLeastSpeedShare + (1.0 - kLeastSpeedShare) * share();
  const bool stops = share() < kStopShare;
  wandering_to_.speed_mps = stops ? 0.0 : speed_share * options_.limits.speed_mps;
  wanders_until_s_ = t_s + share() * (stops ? kLongestStop_s : kLongestWay_s);
  return wandering_to_;
}

double GuestDriver::share() {
  constexpr std::size_t kParts = 1U << 20U;
  return static_cast<double>(random_index(random_, kParts)) / kParts;
}

}  // namespace hlc::guest
