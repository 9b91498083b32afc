#pragma once

#include <any>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "planner/geometry/pose.hpp"

/// The lab's messages as plain data, with the fields that a controller, a middleware and a vehicle
/// need (cpm lab wire contract). Times are nanoseconds of the run's clock. `hlc_bridge/dds`
/// converts.
namespace hlc {

using Nanoseconds = std::uint64_t;

/// next_start of a SystemTrigger that means "stop".
inline constexpr Nanoseconds kStopSymbol = 0xFFFF'FFFF'FFFF'FFFFULL;
/// A vehicle's state is valid this long after it was created.
inline constexpr Nanoseconds kStateDelay = 60'000'000;
/// A vehicle drops a command this long after its valid_after stamp.
inline constexpr Nanoseconds kCommandLifetime = 1'000'000'000;
/// Each copy of a command becomes valid this long after the one before, so that the vehicle can
/// drive the whole plan even if its controller dies at once.
inline constexpr Nanoseconds kCopyDelay = 800'000'000;

/// The lab's vehicle evaluates the points of its command until so long after `now`.
inline constexpr Nanoseconds kLookAhead = 360'000'000;
/// Period of the vehicle's ticks.
inline constexpr Nanoseconds kVehiclePeriod = 20'000'000;

struct VehicleState {
  std::uint8_t vehicle_id{};
  Nanoseconds create_stamp{};
  Nanoseconds valid_after_stamp{};
  Pose pose;                     ///< heading_rad is the vehicle's yaw
  Nanoseconds ips_update_age{};  ///< since the lab's cameras measured the position, at create_stamp
  double odometer_distance_m{};
  double imu_acceleration_forward_mps2{};
  double imu_acceleration_left_mps2{};
  double imu_acceleration_up_mps2{};
  double imu_yaw_rad{};
  double imu_yaw_rate_radps{};
  double speed_mps{};
  double battery_voltage_v{};
  double motor_current_a{};
  double motor_throttle{};
  double steering_servo{};
  bool is_real{};
};

struct VehicleObservation {
  std::uint8_t vehicle_id{};
  Nanoseconds create_stamp{};
  Nanoseconds valid_after_stamp{};
  Pose pose;
};

struct VehicleStateList {
  Nanoseconds t_now{};
  std::uint64_t period_ms{};
  std::vector<VehicleState> states;
  std::vector<VehicleObservation> observations;
  std::vector<std::int32_t> active_vehicle_ids;
};

struct TrajectoryPoint {
  Nanoseconds t{};
  double x_m{};
  double y_m{};
  double vx_mps{};
  double vy_mps{};
};

struct TrajectoryCommand {
  std::uint8_t vehicle_id{};
  Nanoseconds create_stamp{};
  Nanoseconds valid_after_stamp{};
  std::vector<TrajectoryPoint> points;
};

struct PathPoint {
  Pose pose;
  double s_m{};  ///< arc length from the path's begin
};

/// A path, closed if it ends where it begins, and how fast to drive it.
struct PathTrackingCommand {
  std::uint8_t vehicle_id{};
  Nanoseconds create_stamp{};
  Nanoseconds valid_after_stamp{};
  std::vector<PathPoint> path;
  double speed_mps{};
};

struct SpeedCurvatureCommand {
  std::uint8_t vehicle_id{};
  Nanoseconds create_stamp{};
  Nanoseconds valid_after_stamp{};
  double speed_mps{};
  double curvature_per_m{};  ///< positive to the left
};

struct DirectCommand {
  std::uint8_t vehicle_id{};
  Nanoseconds create_stamp{};
  Nanoseconds valid_after_stamp{};
  double motor_throttle{};  ///< in [-1, 1]
  double steering_servo{};  ///< in [-1, 1], positive to the left
};

struct ReadyStatus {
  std::string source_id;
  Nanoseconds next_start{};
};

struct SystemTrigger {
  Nanoseconds next_start{};
};

/// Value of a lab parameter; the alternatives stand in the order of the lab's ParameterType. The
/// first one (Invalid) is what an unknown parameter has.
using ParameterValue = std::variant<std::monostate, bool, std::int32_t, std::uint64_t, double,
                                    std::string, std::vector<std::int32_t>, std::vector<double>>;

struct Parameter {
  std::string name;
  ParameterValue value;
};

struct ParameterRequest {
  std::string name;
};

/// Requests that the lab control stops all vehicles.
struct StopRequest {
  std::uint8_t vehicle_id{};
};

/// One line of a program for the operator. Level 1 is critical, 3 is verbose.
struct Log {
  std::string id;  ///< of the program
  std::string content;
  Nanoseconds stamp{};
  std::uint16_t level{1};
};

/// Programs publish the lines whose level is not above this.
struct LogLevel {
  std::uint16_t level{1};
};

/// A goal of a CommonRoad planning problem, published by the control centre for the controllers of
/// a scenario. Middlewares forward it without reading it: only `hlc_bridge/dds` knows its content.
struct GoalState {
  std::any payload;
};

/// What a Visualization draws of its points. In the lab's order.
enum class DrawingKind : std::uint8_t { kLineStrips, kPolygon, kText, kFilledCircle };

/// Which point of its text a text is anchored at. In the lab's order.
enum class TextAnchor : std::uint8_t {
  kBottomLeft,
  kBottomCenter,
  kBottomRight,
  kCenterLeft,
  kCenter,
  kCenterRight,
  kTopLeft,
  kTopCenter,
  kTopRight
};

struct DrawingColor {
  std::uint8_t alpha{255};
  std::uint8_t red{};
  std::uint8_t green{};
  std::uint8_t blue{};
};

/// Something to draw on the operator's map. A later one with the same id replaces it.
struct Visualization {
  std::uint64_t id{};
  DrawingKind kind{};
  Nanoseconds time_to_live{};
  std::vector<Point> points_m;
  double size_m{};  ///< of a line its width, of a text its height
  std::string text;
  TextAnchor anchor{};
  DrawingColor color;
};

}  // namespace hlc
