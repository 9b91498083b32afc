#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "planner/scenario/scenario.hpp"
#include "vehicle_sim/closed_loop/simulated_network.hpp"
#include "vehicle_sim/closed_loop/simulated_process.hpp"

namespace hlc::closed_loop {

enum class Role : std::uint8_t { kLabControl, kVehicle, kMiddleware, kController };

/// Which process of a run.
struct ProcessKey {
  Role role{};
  std::uint8_t vehicle{};  ///< 0: the lab control's
};
/// The name that its participants bear (messages/node_names.hpp).
[[nodiscard]] std::string name_of(const ProcessKey& key);

/// How one controller differs from the others of a scenario with two rounds.
enum class Difference : std::uint8_t {
  kSequential,  ///< it does not share
  kOtherBasis,  ///< it plans by other rules than the others know of it
  kOtherBits,  ///< its plans have other digests than those that the others compute from its traffic
};

struct DifferentController {
  std::uint8_t vehicle{};
  Difference difference{};
};
[[nodiscard]] std::string to_string(const DifferentController& one);

struct LabSettings {
  /// Delays, clocks, starts of processes and noise of measurements.
  std::uint64_t seed{};
  bool is_logical{};
  Transport transport{};
  std::uint64_t steps{100};  ///< of the run in logical time; in real time it is interrupted
  Nanoseconds progress_interval{60 * kNanosecondsPerSecond};  ///< of the lab control's progress
  /// The scenario's subgraph; none: each run prepares it.
  std::optional<controller::PreparedSubgraph> prepared{};
  std::optional<DifferentController> different{};

  [[nodiscard]] bool differs(std::uint8_t vehicle, Difference how) const {
    return different && different->vehicle == vehicle && different->difference == how;
  }
};

/// Creates the processes of a scenario's run, each as its program would: machine, rules, endpoints.
class ProcessFactory {
 public:
  ProcessFactory(const scenario::Scenario& scenario, const LabSettings& settings);

  [[nodiscard]] const std::vector<std::uint8_t>& vehicle_ids() const { return ids_; }
  /// In the order in which they are numbered everywhere: the lab control, then by vehicle.
  [[nodiscard]] std::vector<ProcessKey> processes() const;
  [[nodiscard]] NodeDescription description(const ProcessKey& key) const;
  /// @param start  of a vehicle that has driven before: its pose
  [[nodiscard]] std::unique_ptr<SimulatedProcess> make(const ProcessKey& key,
                                                       const ProcessPlace& place,
                                                       const std::optional<Pose>& start) const;
  /// Initial pose of the vehicle; heading_rad is the yaw.
  [[nodiscard]] Pose first_pose(std::uint8_t vehicle) const;

 private:
  const scenario::Scenario* scenario_;
  LabSettings settings_;
  std::vector<std::uint8_t> ids_;
};

}  // namespace hlc::closed_loop
