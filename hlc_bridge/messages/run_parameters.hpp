#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "hlc_bridge/messages/time_grid.hpp"

namespace hlc {

/// Names of the lab control's parameters that every run needs (wire contract, 5.1).
inline constexpr const char* kPeriodParameter = "middleware_period_ms";
inline constexpr const char* kActiveIdsParameter = "active_vehicle_ids";

/// What a process knows of a run from the lab control's answers.
class RunParameters {
 public:
  /// The first answer with the right type counts; others are ignored.
  void take(const Parameter& parameter);

  /// Names that have not yet been answered.
  [[nodiscard]] std::vector<std::string> missing() const;
  [[nodiscard]] bool complete() const { return period_ && active_ids_; }

  /// @pre complete()
  [[nodiscard]] Nanoseconds period() const { return *period_; }
  [[nodiscard]] const std::vector<std::int32_t>& active_ids() const { return *active_ids_; }

 private:
  std::optional<Nanoseconds> period_;
  std::optional<std::vector<std::int32_t>> active_ids_;
};

}  // namespace hlc
