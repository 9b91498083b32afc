#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "planner/controller/controller.hpp"

namespace hlc {

enum class MessageKind { kTraffic, kPrediction, kOutcome };

/// One message on its way, for a rollout that loses some.
struct Delivery {
  MessageKind kind;
  StepIndex step;
  VehicleId from;
  VehicleId to;
};

/// Controllers stepped together, each driven by a vehicle that follows its plan perfectly: planning
/// and coordination alone, for look-ahead, campaigns and tests. Messages are handed over in memory;
/// vehicles plan in the order of their priorities, so that nobody waits.
class Rollout {
 public:
  /// @param controllers  one per vehicle, any order
  /// @param starts       planned pose of each at the start, standing
  Rollout(std::vector<std::unique_ptr<Controller>> controllers, const std::vector<Pose>& starts);

  /// The same vehicles in the same state, going their own way from here; loses nothing.
  [[nodiscard]] Rollout clone() const;

  /// Messages for which this says true do not arrive. None by default.
  void lose(std::function<bool(const Delivery&)> is_lost) { is_lost_ = std::move(is_lost); }

  /// One control step of all vehicles; reports in the order of priorities.
  std::vector<Report> step();

  [[nodiscard]] StepIndex next_step() const { return next_step_; }
  [[nodiscard]] const std::vector<std::unique_ptr<Controller>>& controllers() const {
    return controllers_;
  }

 private:
  Rollout() = default;
  [[nodiscard]] std::vector<MeasuredVehicle> measure(StepIndex step) const;
  [[nodiscard]] bool arrives(MessageKind kind, VehicleId from, VehicleId to) const;

  std::vector<std::unique_ptr<Controller>> controllers_;
  std::function<bool(const Delivery&)> is_lost_;
  StepIndex next_step_{0};
};

}  // namespace hlc
