#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <random>
#include <utility>
#include <vector>

#include "planner/right_of_way/way_on.hpp"
#include "planner/scenario/scenario.hpp"

namespace hlc::right_of_way {

inline constexpr double kLongestStep_m = 0.16;

/// Cars that drive at random speeds to the ends of their authorities.
class RandomTraffic {
 public:
  /// @param longest_wait  no vehicle counts more steps: with less than 50 nothing is reserved
  RandomTraffic(const scenario::Scenario& scenario, std::uint64_t seed, double look_ahead_m,
                std::uint32_t longest_wait = std::numeric_limits<std::uint32_t>::max())
      : map_(*scenario.conflicts),
        look_ahead_m_(look_ahead_m),
        longest_wait_(longest_wait),
        random_(seed) {
    for (const scenario::ScenarioVehicle& vehicle : scenario.vehicles) {
      holders_.push_back({.vehicle = vehicle.id,
                          .claim = {.route = vehicle.route_number, .place_m = vehicle.start_s_m}});
    }
  }

  /// Longest time, in steps, for which a vehicle has stood. @param leaves_a_way_on  way_on.hpp
  std::uint32_t step(bool leaves_a_way_on = true) {
    const std::uint32_t longest = drive(0.01);
    before_ = holders_;
    const std::vector<double> ahead_m = grant(map_, holders_, {}, look_ahead_m_);
    std::vector<Taken> taken(ahead_m.size());
    if (leaves_a_way_on) taken = leave_a_way_on(map_, holders_, ahead_m, {});
    for (std::size_t i = 0; i < holders_.size(); ++i) {
      coordination::LaneClaim& claim = holders_[i].claim;
      claim.ahead_m = leaves_a_way_on ? taken[i].ahead_m : ahead_m[i];
      has_declined_[holders_[i].vehicle] = taken[i].declines;
    }
    return longest;
  }

  /// Messages are lost with this probability, or none between two vehicles gets through for a time.
  /// Returns how many vehicles had not received all.
  std::size_t step_with_losses(double share_lost, double shortest_step_m) {
    static_cast<void>(drive(shortest_step_m));
    std::vector<Holder> after;
    std::size_t num_cautious = 0;
    for (const Holder& own : holders_) {
      std::vector<Holder> received;
      std::vector<Missing> missing;
      for (const Holder& other : holders_) {
        const bool is_received =
            other.vehicle == own.vehicle || is_delivered(other, own, share_lost);
        Missing& known =
            known_.try_emplace({own.vehicle, other.vehicle}, Missing{.last = other}).first->second;
        if (is_received) {
          known = {.last = other};
          received.push_back(other);
        } else {
          known.moved_m += kLongestStep_m;
          missing.push_back(known);
        }
      }
      const auto cautious =
          missing.empty() ? std::nullopt
                          : cautious_grant(map_, received, missing, {}, look_ahead_m_, own.vehicle);
      num_cautious += cautious ? 1U : 0U;
      const std::vector<Holder> all = cautious ? *cautious : granted(received);
      after.push_back(*std::ranges::find(all, own.vehicle, &Holder::vehicle));
    }
    holders_ = std::move(after);
    return num_cautious;
  }

  [[nodiscard]] const std::vector<Holder>& holders() const { return holders_; }
  /// As the last step began.
  [[nodiscard]] const std::vector<Holder>& before() const { return before_; }

 private:
  [[nodiscard]] std::vector<Holder> granted(std::vector<Holder> holders) const {
    const std::vector<double> ahead_m = grant(map_, holders, {}, look_ahead_m_);
    for (std::size_t i = 0; i < holders.size(); ++i) holders[i].claim.ahead_m = ahead_m[i];
    return holders;
  }

  /// Longest time, in steps, for which a vehicle has stood.
  std::uint32_t drive(double shortest_step_m) {
    std::uint32_t longest = 0;
    for (std::size_t i = 0; i < holders_.size(); ++i) {
      coordination::LaneClaim& claim = holders_[i].claim;
      const double moved_m = std::min(
          claim.ahead_m, std::uniform_real_distribution(shortest_step_m, kLongestStep_m)(random_));
      claim.place_m = std::fmod(claim.place_m + moved_m, map_.length_m(claim.route));
      claim.ahead_m -= moved_m;
      const bool waits = moved_m < 0.002 && !has_declined_[holders_[i].vehicle];
      claim.waiting_steps = waits ? std::min(claim.waiting_steps + 1, longest_wait_) : 0;
      std::uint32_t& stood_steps = stood_steps_[holders_[i].vehicle];
      stood_steps = moved_m < 0.002 ? stood_steps + 1 : 0;
      longest = std::max(longest, stood_steps);
    }
    return longest;
  }

  bool is_delivered(const Holder& from, const Holder& to, double share_lost) {
    std::uniform_real_distribution<double> any(0.0, 1.0);
    int& cut_steps = cut_steps_[{from.vehicle, to.vehicle}];
    if (cut_steps == 0 && any(random_) < 0.1 * share_lost) {
      cut_steps = std::uniform_int_distribution(2, 40)(random_);
    }
    if (cut_steps > 0) --cut_steps;
    return cut_steps == 0 && any(random_) >= share_lost;
  }

  const ConflictMap& map_;
  double look_ahead_m_;
  std::uint32_t longest_wait_;
  std::mt19937_64 random_;
  std::vector<Holder> before_;
  std::map<VehicleId, std::uint32_t> stood_steps_;
  std::map<VehicleId, bool> has_declined_;
  std::vector<Holder> holders_;
  std::map<std::pair<VehicleId, VehicleId>, Missing> known_;  ///< to the first, of the second
  std::map<std::pair<VehicleId, VehicleId>, int> cut_steps_;  ///< from the first to the second
};

}  // namespace hlc::right_of_way
