#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "planner/controller/observation.hpp"
#include "planner/coordination/guest.hpp"

namespace hlc::controller {

/// One controller's knowledge of the guests: the last usable state of each. A value.
class Guests {
 public:
  explicit Guests(const std::vector<coordination::Guest>& guests);

  /// Takes the states of step k. A guest without one may be wherever it can have got to since the
  /// last; one that was never seen is not there.
  void observe(const Observation& observation);

  /// Guests that were seen, in the order given.
  [[nodiscard]] std::vector<VehicleId> seen() const;
  /// HorizonProblem::avoided_in_motion_m because of these guests.
  [[nodiscard]] std::vector<std::vector<ConvexPolygon>> avoided_in_motion_m(
      std::span<const VehicleId> guests, std::size_t horizon_steps, double step_s) const;
  /// What the guest can reach in each of the steps t(k+1) ... t(k+1+horizon). @pre it was seen
  [[nodiscard]] std::vector<ConvexPolygon> reachable_m(VehicleId guest, std::size_t horizon_steps,
                                                       double step_s) const;

 private:
  struct Seen {
    coordination::Guest guest;
    std::optional<coordination::MeasuredVehicle> last;
    StepIndex step;  ///< of `last`
  };

  std::vector<Seen> guests_;
  StepIndex now_;  ///< k
};

}  // namespace hlc::controller
