#pragma once

#include <map>
#include <vector>

#include "hlc_bridge/messages/run_parameters.hpp"
#include "hlc_bridge/middleware/state_buffer.hpp"

namespace hlc::middleware {

/// Composes the lists for the controllers from the messages of vehicles and cameras.
class ListComposer {
 public:
  /// @param with_observations  the list holds the newest observation of every active vehicle in the
  /// order of the active vehicles, a default-constructed one for a vehicle without any; otherwise
  /// none
  explicit ListComposer(bool with_observations) : with_observations_{with_observations} {}

  /// @param vehicle_id  the vehicle of the topic
  void add(std::uint8_t vehicle_id, const VehicleState& state) { states_.add(vehicle_id, state); }
  /// The one with the largest create_stamp counts, the later arrival among equals.
  void add(std::uint8_t vehicle_id, const VehicleObservation& observation);

  /// True if a state with create_stamp >= `create_stamp` has arrived from the vehicle.
  [[nodiscard]] bool holds_state(std::uint8_t vehicle_id, Nanoseconds create_stamp) const {
    return states_.holds(vehicle_id, create_stamp);
  }

  /// The list of time `t_now`, which never decreases. @pre parameters.complete()
  [[nodiscard]] VehicleStateList compose(Nanoseconds t_now, const RunParameters& parameters);

  /// t_now of the last list; 0 before the first one.
  [[nodiscard]] Nanoseconds newest_list() const { return newest_list_; }

 private:
  bool with_observations_;
  StateBuffer states_;
  std::map<std::uint8_t, VehicleObservation> observations_;
  Nanoseconds newest_list_{};
};

}  // namespace hlc::middleware
