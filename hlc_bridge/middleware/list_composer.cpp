#include "hlc_bridge/middleware/list_composer.hpp"

namespace hlc::middleware {

void ListComposer::add(std::uint8_t vehicle_id, const VehicleObservation& observation) {
  VehicleObservation& newest = observations_[vehicle_id];
  if (observation.create_stamp >= newest.create_stamp) newest = observation;
}

VehicleStateList ListComposer::compose(Nanoseconds t_now, const RunParameters& parameters) {
  newest_list_ = t_now;
  states_.forget_before(t_now);
  VehicleStateList list =
      compose_state_list(states_, t_now, parameters.period(), parameters.active_ids());
  if (with_observations_) {
    for (const std::int32_t id : parameters.active_ids()) {
      list.observations.push_back(observations_[static_cast<std::uint8_t>(id)]);
    }
  }
  return list;
}

}  // namespace hlc::middleware
