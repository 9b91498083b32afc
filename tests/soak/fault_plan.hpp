#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace hlc::test {

/// What is done to a process or to a machine of a run of three cars.
enum class FaultKind : std::uint8_t {
  kKillController,
  kStopController,    ///< SIGSTOP, and SIGCONT after `lasts_s`
  kReturnController,  ///< killed, and started again after `lasts_s`
  kKillMiddleware,
  kStopMiddleware,
  kKillVehicle,
  kKillLabControl,
  kCutNetwork,  ///< the vehicle's machine, for `lasts_s`
};

struct PlannedFault {
  FaultKind kind{};
  int vehicle{};     ///< 1 ... 3; 0: the lab control's
  double at_s{};     ///< since all cars drive
  double lasts_s{};  ///< of faults that pass
};

/// The faults of one run, in the order of time.
struct FaultPlan {
  bool over_network{};  ///< a machine per car, and only the network fails; else all on one machine
  std::vector<PlannedFault> faults;
};

/// The same for the same arguments. The first fault comes within 8 s, each further one within 2.5 s
/// of the one before, so that most of them meet cars that still deal with the last one. Faults that
/// pass last 0.1 s ... 3.5 s: the others' patience is 2 s, and a car stands after 2.5 s.
/// @param with_network  one in six runs is over the network
[[nodiscard]] FaultPlan plan_faults(std::uint64_t seed, int num_faults, bool with_network);

/// "2.31 s middleware_2 stopped for 0.70 s".
[[nodiscard]] std::string to_text(const PlannedFault& fault);

/// Name among LabProcesses of the process that the fault strikes. @pre not kCutNetwork
[[nodiscard]] std::string struck_process(const PlannedFault& fault);

}  // namespace hlc::test
