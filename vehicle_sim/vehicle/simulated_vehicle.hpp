#pragma once

#include <cstdint>
#include <optional>
#include <tuple>
#include <utility>

#include "hlc_bridge/messages/messages.hpp"
#include "hlc_bridge/result/run_record.hpp"
#include "vehicle_sim/guest/guest_driver.hpp"
#include "vehicle_sim/plant/plant.hpp"
#include "vehicle_sim/tracking/command_buffer.hpp"
#include "vehicle_sim/tracking/command_laws.hpp"
#include "vehicle_sim/tracking/follower.hpp"
#include "vehicle_sim/tracking/lab_follower.hpp"
#include "vehicle_sim/tracking/pose_estimator.hpp"

namespace hlc::simulated_vehicle {

/// Which pose the state stamped `t` shows, and who follows trajectories.
enum class Stamps : std::uint8_t {
  kExact,  ///< the pose at t; Follower
  /// The lab's simulated vehicle: it moves on for a tick and then stamps, so the pose is that of
  /// t + 20 ms; LabFollower
  kLab,
};

struct SimulatedVehicleOptions {
  std::uint8_t vehicle_id{};
  Pose start;                               ///< finite
  std::optional<std::uint64_t> noise_seed;  ///< none: the pose is measured exactly
  tracking::FollowerGains gains;            ///< of kExact
  vehicle::IdentifiedVehicle vehicle;
  Stamps stamps{Stamps::kExact};
  /// Of a guest that nobody else drives; none: the vehicle follows received commands.
  std::optional<guest::GuestDriverOptions> driver{};
};

/// A whole µCar without network and clock: commands in, states out, one call per tick of 20 ms. The
/// vehicle's process and every closed loop in one process use this class.
///
/// A tick: measure, estimate, choose the command, follow it (or stop), give the input to the plant.
/// The result is the vehicle at `t_now`, before the plant moves on. With Stamps::kLab it measures
/// and estimates after the plant has moved on: state and observation lie a tick ahead of their
/// stamps, and the next input is computed from them. `driven` is the true motion at its time with
/// both.
///
/// Of usable commands of several kinds the first of this order counts, as in the lab: direct, speed
/// and curvature, trajectory, path tracking.
class SimulatedVehicle {
 public:
  /// After a stop the vehicle brakes for this many ticks (1 s).
  static constexpr int kBrakingTicks = 50;

  struct Tick {
    VehicleState state;  ///< the published state: the vehicle's estimate, valid 60 ms later
    VehicleObservation observation;  ///< from the lab's camera system: the measured pose
    result::DrivenSample driven;     ///< true; command_create is 0 unless a command was followed
    tracking::FollowerStatus status{tracking::FollowerStatus::kNoCommand};
  };

  /// @throws std::invalid_argument if the start pose is not finite
  explicit SimulatedVehicle(const SimulatedVehicleOptions& options);

  /// To be called in the order of arrival.
  template <class Command>
  void receive(Command command) {
    std::get<tracking::CommandBuffer<Command>>(commands_).add(std::move(command));
  }

  /// @param t_now  multiples of 20 ms, increasing
  Tick tick(Nanoseconds t_now);

  /// The stop symbol: the stop law for `kBrakingTicks` ticks, whatever is commanded. Then all
  /// commands received so far are dropped, and the vehicle listens again.
  void brake() { braking_ticks_left_ = kBrakingTicks; }
  [[nodiscard]] bool is_braking() const { return braking_ticks_left_ > 0; }

  /// True pose and speed at the next tick.
  [[nodiscard]] const vehicle::VehicleMotion& motion() const { return plant_.motion(); }

 private:
  struct Decision {
    vehicle::ActuatorInput input;
    tracking::FollowerStatus status{tracking::FollowerStatus::kNoCommand};
    Nanoseconds command_create{};  ///< of the active command
  };

  void measure();
  [[nodiscard]] Decision decide(Nanoseconds t_now);
  [[nodiscard]] tracking::Follower::Output follow(Nanoseconds t_now,
                                                  const TrajectoryCommand* command);

  std::uint8_t vehicle_id_;
  plant::Plant plant_;
  tracking::PoseEstimator estimator_;
  plant::Measurement measured_;      ///< the last one
  vehicle::VehicleMotion estimate_;  ///< from it
  std::tuple<tracking::CommandBuffer<DirectCommand>, tracking::CommandBuffer<SpeedCurvatureCommand>,
             tracking::CommandBuffer<TrajectoryCommand>,
             tracking::CommandBuffer<PathTrackingCommand>>
      commands_;
  tracking::Follower follower_;
  std::optional<tracking::LabFollower> lab_follower_;  ///< Stamps::kLab
  tracking::SpeedControl speed_control_;
  std::optional<guest::GuestDriver> driver_;
  int braking_ticks_left_{};
};

}  // namespace hlc::simulated_vehicle
