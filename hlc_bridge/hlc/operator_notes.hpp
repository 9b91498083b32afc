#pragma once

#include <optional>
#include <string>

#include "hlc_bridge/hlc/hlc_events.hpp"
#include "planner/controller/controller.hpp"

namespace hlc {

/// What a step tells the operator in the log: each fact once, not in every step in which it holds.
class OperatorNotes {
 public:
  /// Before the start: where the vehicle stands, once it is seen, and again whenever it begins or
  /// ceases to fit its route.
  void note_placement(const Controller& controller, HlcActions& actions);

  /// Why the vehicle stays with its former plan, where that may last. A used up budget once in a
  /// run: where one is too small now and then, the summary says how often.
  void note_fallback(const Controller& controller, const Report& report, HlcActions& actions);

  /// @param fault  of the command of a step (AnswerToList)
  void note_fault(StepIndex step, const std::string& fault, HlcActions& actions);

 private:
  std::optional<bool> logged_fit_;  ///< whether the vehicle fits, as logged last
  bool is_off_route_logged_{};
  bool is_budget_logged_{};
  std::string last_fault_;
};

}  // namespace hlc
