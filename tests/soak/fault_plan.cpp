#include "tests/soak/fault_plan.hpp"

#include <array>
#include <cstdio>
#include <random>

namespace hlc::test {
namespace {

constexpr int kVehicles = 3;
constexpr std::uint64_t kRunsPerNetworkRun = 6;
constexpr double kLatestFirst_s = 8.0;
constexpr double kLongestPause_s = 2.5;
constexpr double kShortest_s = 0.1;
constexpr double kLongest_s = 3.5;

// The lab control is one process among ten: it is struck as rarely.
constexpr std::array kOnOneMachine{
    FaultKind::kKillController,   FaultKind::kStopController,   FaultKind::kKillMiddleware,
    FaultKind::kKillController,   FaultKind::kStopController,   FaultKind::kKillMiddleware,
    FaultKind::kStopMiddleware,   FaultKind::kKillVehicle,      FaultKind::kStopController,
    FaultKind::kReturnController, FaultKind::kReturnController, FaultKind::kKillLabControl};

class Dice {
 public:
  explicit Dice(std::uint64_t seed) : bits_(seed) {}

  std::uint64_t below(std::uint64_t n) { return bits_() % n; }
  double between(double a, double b) {
    return a + (b - a) * static_cast<double>(below(1'000'000)) / 1e6;
  }

 private:
  std::mt19937_64 bits_;
};

bool passes(FaultKind kind) {
  return kind == FaultKind::kStopController || kind == FaultKind::kReturnController ||
         kind == FaultKind::kStopMiddleware || kind == FaultKind::kCutNetwork;
}

std::string number(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.2f", value);
  return text.data();
}

}  // namespace

FaultPlan plan_faults(std::uint64_t seed, int num_faults, bool with_network) {
  Dice dice(seed);
  FaultPlan plan;
  plan.over_network = with_network && dice.below(kRunsPerNetworkRun) == 0;
  double now_s = 0.0;
  for (int i = 0; i < num_faults; ++i) {
    PlannedFault fault;
    fault.kind = plan.over_network ? FaultKind::kCutNetwork
                                   : kOnOneMachine.at(dice.below(kOnOneMachine.size()));
    fault.vehicle =
        fault.kind == FaultKind::kKillLabControl ? 0 : static_cast<int>(1 + dice.below(kVehicles));
    now_s += dice.between(0.0, i == 0 ? kLatestFirst_s : kLongestPause_s);
    fault.at_s = now_s;
    if (passes(fault.kind)) fault.lasts_s = dice.between(kShortest_s, kLongest_s);
    plan.faults.push_back(fault);
  }
  return plan;
}

std::string struck_process(const PlannedFault& fault) {
  const std::string id = std::to_string(fault.vehicle);
  switch (fault.kind) {
    case FaultKind::kKillController:
    case FaultKind::kStopController:
    case FaultKind::kReturnController:
      return "high_level_controller_" + id;
    case FaultKind::kKillMiddleware:
    case FaultKind::kStopMiddleware:
      return "middleware_" + id;
    case FaultKind::kKillVehicle:
      return "vehicle_" + id;
    case FaultKind::kKillLabControl:
    case FaultKind::kCutNetwork:
      break;
  }
  return "lab_control";
}

std::string to_text(const PlannedFault& fault) {
  std::string text = number(fault.at_s) + " s ";
  if (fault.kind == FaultKind::kCutNetwork) {
    text += "machine " + std::to_string(fault.vehicle) + " cut off";
  } else {
    const bool is_stopped = passes(fault.kind) && fault.kind != FaultKind::kReturnController;
    text += struck_process(fault) + (is_stopped ? " stopped" : " killed");
  }
  return passes(fault.kind) ? text + " for " + number(fault.lasts_s) + " s" : text;
}

}  // namespace hlc::test
