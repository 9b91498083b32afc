#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "hlc_bridge/result/run_record.hpp"

namespace hlc::result {

/// Why a vehicle did what it did in a step.
struct Explanation {
  std::uint64_t step{};  ///< from 0: k - k0
  VehicleId vehicle;
  std::string text;  ///< lines
  friend bool operator==(const Explanation&, const Explanation&) = default;
};

/// The steps of which somebody who looks at the run wants an explanation, without their text: those
/// in which a vehicle begins to keep its plan, to drive its last one to the end, to wait for
/// others, or to miss messages of others. By step, then vehicle.
/// @param rows  of step_records()
[[nodiscard]] std::vector<Explanation> steps_to_explain(std::span<const StepRecord> rows);

}  // namespace hlc::result
