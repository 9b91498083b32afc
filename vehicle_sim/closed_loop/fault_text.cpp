#include <array>
#include <cstdio>

#include "vehicle_sim/closed_loop/fault_plan.hpp"

namespace hlc::closed_loop {
namespace {

std::string seconds(Nanoseconds time) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.3f s", 1e-9 * static_cast<double>(time));
  return text.data();
}

std::string amount_text(const Fault& fault) {
  std::array<char, 64> text{};
  const double amount_ms = 1e-6 * static_cast<double>(fault.amount);
  switch (fault.kind) {
    case FaultKind::kLose:
    case FaultKind::kWithhold:
      std::snprintf(text.data(), text.size(), ", %.0f %%", 100.0 * fault.share);
      break;
    case FaultKind::kRepeat:
    case FaultKind::kReorder:
      std::snprintf(text.data(), text.size(), ", %.0f %%, up to %.1f ms", 100.0 * fault.share,
                    amount_ms);
      break;
    case FaultKind::kDelay:
      std::snprintf(text.data(), text.size(), ", up to %.1f ms", amount_ms);
      break;
    case FaultKind::kStep:
      std::snprintf(text.data(), text.size(), ", %+.3f ms", amount_ms);
      break;
    case FaultKind::kDrift:
      std::snprintf(text.data(), text.size(), ", %+.3f ms/s", amount_ms);
      break;
    case FaultKind::kFlood:
      std::snprintf(text.data(), text.size(), ", %lld a second",
                    static_cast<long long>(fault.amount));
      break;
    case FaultKind::kCut:
    case FaultKind::kKill:
    case FaultKind::kFreeze:
      break;
  }
  return text.data();
}

}  // namespace

const char* to_string(FaultKind kind) {
  switch (kind) {
    case FaultKind::kLose:
      return "lose";
    case FaultKind::kWithhold:
      return "withhold";
    case FaultKind::kDelay:
      return "delay";
    case FaultKind::kRepeat:
      return "repeat";
    case FaultKind::kReorder:
      return "reorder";
    case FaultKind::kFlood:
      return "flood";
    case FaultKind::kCut:
      return "cut";
    case FaultKind::kKill:
      return "kill";
    case FaultKind::kFreeze:
      return "freeze";
    case FaultKind::kStep:
      return "step";
    case FaultKind::kDrift:
      return "drift";
  }
  return "";
}

std::string to_string(const Fault& fault) {
  const auto name = [](const std::string& process) {
    return process.empty() ? std::string("any") : process;
  };
  const std::string end = fault.end == kForGood ? "end" : seconds(fault.end);
  std::string text = seconds(fault.begin) + " ... " + end + ": " + to_string(fault.kind) + " " +
                     name(fault.process);
  if (fault.kind < FaultKind::kKill) text += " -> " + name(fault.peer);
  return text + amount_text(fault);
}

}  // namespace hlc::closed_loop
