#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "planner/controller/controller.hpp"
#include "planner/controller/followed_plan.hpp"
#include "tests/support/test_automaton.hpp"

namespace hlc::test {

/// The automaton of two labels, of which every maneuver holds a criterion "one" of 1 and a
/// criterion "fast" of 1 for the label kFast, 0 for others.
inline std::shared_ptr<const UniversalAutomaton> automaton_with_criteria() {
  static const std::shared_ptr<const UniversalAutomaton> automaton = [] {
    auto made = make_test_automaton(paper_trims(), {kSlow, kFast});
    for (Maneuver& maneuver : made->maneuvers) {
      maneuver.criteria = {{"one", 1.0}, {"fast", maneuver.label == kFast.label ? 1.0 : 0.0}};
    }
    return made;
  }();
  return automaton;
}

inline std::shared_ptr<const Subgraph> subgraph_of_label(const std::string& label) {
  SubgraphSpec spec = make_test_subgraph({kSlow, kFast}, kAllTrims).spec();
  spec.name = label;
  spec.labels = {label};
  return std::make_shared<const Subgraph>(automaton_with_criteria(), spec);
}

/// A car that shall drive east along y = 0 and stands at x = 0 in step 100.
class DrivenController {
 public:
  explicit DrivenController(std::shared_ptr<const Subgraph> subgraph = subgraph_of_label("slow"))
      : controller_(std::make_unique<Controller>(
            ControllerOptions{.vehicle = {2}}, std::move(subgraph),
            ReferencePath({{0.0, 0.0}, {40.0, 0.0}}, false), Corridor{})) {
    const UniversalAutomaton& automaton = controller_->subgraph().automaton();
    static_cast<void>(controller_->stand_by({.step = now_,
                                             .active = {{2}},
                                             .states = {as_measured({2}, {}, automaton)},
                                             .present = {{2}}}));
  }

  Controller& operator*() { return *controller_; }
  Controller* operator->() { return controller_.get(); }
  /// Goes its own way from here.
  [[nodiscard]] DrivenController clone() const {
    return {std::make_unique<Controller>(*controller_), now_};
  }
  [[nodiscard]] StepIndex next_step() const { return {now_.value + 1}; }

  /// A step with messages from these others.
  Report step(const std::vector<Traffic>& traffic = {},
              const std::vector<Prediction>& predictions = {}) {
    ++now_.value;
    Observation observation{
        .step = now_, .active = {{2}}, .states = {on_its_plan(*controller_, now_)}, .present = {}};
    for (const Traffic& other : traffic) observation.active.push_back(other.vehicle);
    observation.present = observation.active;
    static_cast<void>(controller_->observe(observation));
    controller_->couple(traffic);
    static_cast<void>(controller_->plan(predictions));
    return controller_->commit(predictions, {});
  }

 private:
  DrivenController(std::unique_ptr<Controller> controller, StepIndex now)
      : controller_(std::move(controller)), now_(now) {}

  std::unique_ptr<Controller> controller_;
  StepIndex now_{100};
};

}  // namespace hlc::test
