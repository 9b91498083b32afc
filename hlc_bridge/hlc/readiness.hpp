#pragma once

#include <optional>
#include <string>
#include <vector>

#include "hlc_bridge/hlc/hlc_events.hpp"
#include "hlc_bridge/hlc/hlc_rules.hpp"

namespace hlc::high_level_controller {

/// Whether a controller takes part: whether all who need its messages receive them, and whether it
/// is the only instance for its vehicle.
///
/// **Duplicate instances.** A vehicle follows one controller. The one that was ready first stays: a
/// second one that finds its vehicle's name on the lab domain is never ready, publishes nothing and
/// leaves. Where both are ready (one was cut off or stopped for longer than its lease, and has been
/// replaced), the vehicle would follow each of them in turn, and its motion could not be predicted:
/// each leaves as soon as it receives the other's traffic.
class Readiness {
 public:
  Readiness(VehicleId vehicle, const HlcRules& rules) : vehicle_(vehicle), rules_(rules) {}

  void receive(const HlcPeers& peers);
  /// Another instance has published for the own vehicle. (A process does not receive its own
  /// messages.)
  void receive_own_traffic() { is_duplicate_received_ = true; }
  /// Active vehicles of the last list.
  void set_active(std::vector<VehicleId> active) { active_ = std::move(active); }

  /// To be called whenever something may have changed. Becomes ready when all participants receive
  /// what is published here; under kAtTrigger also as soon as the middleware does, if the
  /// experiment has started: a controller returns alone into a running experiment, and absent
  /// participants are missing, as in any step. With HlcRules::waits_for_start controllers that have
  /// not appeared within the patience are not waited for either.
  /// @param since_start  wall time
  void update(bool has_started, Nanoseconds since_start);
  [[nodiscard]] bool is_ready() const { return is_ready_; }
  /// Of active vehicles; these have not appeared, or are lost.
  [[nodiscard]] std::set<std::string> absent_controllers() const;

  /// Another instance controls the vehicle: this one must not.
  [[nodiscard]] bool yields_to_duplicate() const;
  /// As before, and the other instance is no trace of a dead one. @param since_start  wall time
  [[nodiscard]] bool leaves_to_duplicate(Nanoseconds since_start) const {
    return yields_to_duplicate() && since_start > rules_.duplicate_patience;
  }

  /// The given vehicles whose controllers are alive. The controllers' network alone may have
  /// failed: a controller that is on the lab's network still commands its vehicle.
  [[nodiscard]] std::vector<VehicleId> present(std::vector<VehicleId> vehicles) const;
  /// True if messages from this vehicle's controller can arrive.
  [[nodiscard]] bool is_reachable(VehicleId vehicle) const;

  /// Why the controller is not ready yet.
  [[nodiscard]] std::string missing() const;

 private:
  [[nodiscard]] bool has_duplicate() const;
  [[nodiscard]] std::set<std::string> unmatched_peers() const;

  VehicleId vehicle_;
  HlcRules rules_;
  HlcPeers peers_;
  std::vector<VehicleId> active_;
  bool is_ready_{};
  bool is_duplicate_received_{};
};

}  // namespace hlc::high_level_controller
