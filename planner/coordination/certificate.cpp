#include "planner/coordination/certificate.hpp"

namespace hlc::coordination {

const char* to_string(KnownMotion known) {
  switch (known) {
    case KnownMotion::kRunning:
      return "running";
    case KnownMotion::kNew:
      return "new";
    case KnownMotion::kReachable:
      return "reachable";
    case KnownMotion::kMissing:
      return "missing";
  }
  return "unknown";
}

std::optional<std::vector<SeparatingLine>> separating_lines(
    const OccupiedAreas& own, StepIndex from, const std::vector<const ConvexPolygon*>& others_m) {
  std::vector<SeparatingLine> lines;
  lines.reserve(others_m.size());
  for (std::size_t j = 0; j < others_m.size(); ++j) {
    const auto line =
        separating_line(own.during({from.value + j}), *others_m[j], kSeparationTolerance_m);
    if (!line) return std::nullopt;
    lines.push_back(*line);
  }
  return lines;
}

}  // namespace hlc::coordination
