#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "planner/coordination/messages.hpp"
#include "planner/coordination/report.hpp"
#include "planner/geometry/footprint.hpp"
#include "vehicle_sim/closed_loop/violation.hpp"

namespace hlc::closed_loop {

/// Within 0.5 s of any fault every vehicle drives only what its controller has agreed and
/// announced, and stands when that has run out. In every tick:
///
/// * **announced**: the driven footprint (without margin) lies in what the controller has announced
///   for this step, last of all, in its traffic or with its new plan; never outside for 0.5 s. What
///   a controller has announced before it died or was cut off holds on, and so does the plan before
///   (the command of the last one may have been lost).
/// * **stands**: a vehicle moves only within `plan_lasts` of its controller's last new plan.
class AnnouncedCheck {
 public:
  static constexpr Nanoseconds kPatience = kNanosecondsPerSecond / 2;
  static constexpr Nanoseconds kBraking = 900 * kNanosecondsPerMillisecond;
  static constexpr double kMoving_mps = 0.1;

  AnnouncedCheck(const Footprint& footprint, std::size_t horizon_steps, Nanoseconds period)
      : footprint_(footprint), horizon_steps_(horizon_steps), period_(period) {}

  /// Horizon and step under way, braking, and the patience.
  [[nodiscard]] Nanoseconds plan_lasts() const {
    return (horizon_steps_ + 1) * period_ + kBraking + kPatience;
  }

  /// @param is_seen  its controller sees the vehicle in this step
  void published(const coordination::Traffic& traffic, bool is_seen = true);
  void predicted(const coordination::Prediction& prediction) {
    cars_[prediction.vehicle].predicted = prediction;
  }
  void reported(const coordination::Report& report, Nanoseconds at);
  /// Before its report nobody knows whether its last prediction came into force: it may have been
  /// commanded.
  void controller_died(VehicleId vehicle) {
    Car& car = cars_[vehicle];
    if (car.predicted) adopt(car);
  }
  /// @param tick  its time
  void driven(VehicleId vehicle, Nanoseconds tick, const Pose& pose, double speed_mps,
              Violations& violations);
  /// Where it is, nobody can know: that is not checked until something new is announced of it by a
  /// controller that has seen it since. @param tick  now
  void exempt(VehicleId vehicle, Nanoseconds tick) {
    Car& car = cars_[vehicle];
    car.is_exempt |= car.running.has_value();
    car.running.reset();
    car.agreed.reset();
    car.before.reset();
    car.outside_since.reset();
    car.last_plan = tick;
  }
  [[nodiscard]] bool is_exempt(VehicleId vehicle) const {
    const auto car = cars_.find(vehicle);
    return car != cars_.end() && car->second.is_exempt;
  }

 private:
  struct Car {
    std::optional<coordination::OccupiedAreas> running;  ///< of the last traffic
    std::optional<coordination::OccupiedAreas> agreed;   ///< of a plan since then
    std::optional<coordination::OccupiedAreas> before;   ///< of the plan before that
    std::optional<coordination::Prediction> predicted;
    std::optional<Nanoseconds> outside_since;
    Nanoseconds last_plan{};
    bool is_exempt{};  ///< since something was announced
    bool is_reported{};
    bool runs_on{};
  };

  static void adopt(Car& car);
  [[nodiscard]] bool is_inside(const Car& car, StepIndex step, const Pose& pose) const;
  void check_area(VehicleId vehicle, Car& car, Nanoseconds tick, const Pose& pose,
                  Violations& violations) const;

  Footprint footprint_;
  std::size_t horizon_steps_;
  Nanoseconds period_;
  std::map<VehicleId, Car> cars_;
};

}  // namespace hlc::closed_loop
