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
  std::uint64_t last{};  ///< step in which what began there ended
  VehicleId vehicle;
  std::string text;  ///< lines
  friend bool operator==(const Explanation&, const Explanation&) = default;
};

/// What a vehicle searched in a step, as a page of its own (planner/plot/search_page.hpp).
struct SearchPage {
  std::uint64_t step{};  ///< from 0: k - k0
  VehicleId vehicle;
  std::string html;
};

/// The steps of which somebody who looks at the run wants an explanation, without their text: those
/// in which a vehicle begins to keep its plan, to drive its last one to the end, to wait for
/// others, or to miss messages of others, and every one in which it brakes to a stand by a new plan
/// without any of these. By step, then vehicle.
/// @param rows  of step_records()
[[nodiscard]] std::vector<Explanation> steps_to_explain(std::span<const StepRecord> rows);

}  // namespace hlc::result
