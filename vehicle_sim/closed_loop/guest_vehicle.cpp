#include "vehicle_sim/closed_loop/guest_vehicle.hpp"

namespace hlc::closed_loop {

simulated_vehicle::SimulatedVehicleOptions guest_vehicle(const scenario::ScenarioGuest& guest,
                                                         std::optional<std::uint64_t> noise_seed,
                                                         simulated_vehicle::Stamps stamps) {
  simulated_vehicle::SimulatedVehicleOptions options{.vehicle_id = guest.guest.vehicle.value,
                                                     .start = guest.start,
                                                     .noise_seed = noise_seed,
                                                     .stamps = stamps};
  if (guest.drive == scenario::GuestDrive::kByHand) return options;
  options.driver = {.vehicle = guest.guest.vehicle,
                    .limits = guest.guest.limits,
                    .track = guest.track,
                    .seed = guest.seed,
                    .home_m = guest.home_m};
  return options;
}

}  // namespace hlc::closed_loop
