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
inline std::shared_ptr<const automaton::UniversalAutomaton> automaton_with_criteria() {
  static const std::shared_ptr<const automaton::UniversalAutomaton> automaton = [] {
    auto made = make_test_automaton(paper_trims(), {kSlow, kFast});
    for (automaton::Maneuver& maneuver : made->maneuvers) {
      maneuver.criteria = {{"one", 1.0}, {"fast", maneuver.label == kFast.label ? 1.0 : 0.0}};
    }
    return made;
  }();
  return automaton;
}

inline std::shared_ptr<const automaton::Subgraph> subgraph_of_label(const std::string& label) {
  automaton::SubgraphSpec spec = make_test_subgraph({kSlow, kFast}, kAllTrims).spec();
  spec.name = label;
  spec.labels = {label};
  return std::make_shared<const automaton::Subgraph>(automaton_with_criteria(), spec);
}

/// A car that shall drive east along y = 0 and stands at x = 0 in step 100.
class DrivenController {
 public:
  explicit DrivenController(
      std::shared_ptr<const automaton::Subgraph> subgraph = subgraph_of_label("slow"))
      : controller_(std::make_unique<controller::Controller>(
            controller::ControllerOptions{.vehicle = {2}}, std::move(subgraph),
            road::ReferencePath({{0.0, 0.0}, {40.0, 0.0}}, false), road::Corridor{})) {
    const automaton::UniversalAutomaton& automaton = controller_->subgraph().automaton();
    static_cast<void>(
        controller_->stand_by({.step = now_,
                               .active = {{2}},
                               .states = {controller::as_measured({2}, {}, automaton)},
                               .present = {{2}}}));
  }

  controller::Controller& operator*() { return *controller_; }
  controller::Controller* operator->() { return controller_.get(); }
  /// Goes its own way from here.
  [[nodiscard]] DrivenController clone() const {
    return {std::make_unique<controller::Controller>(*controller_), now_};
  }
  [[nodiscard]] StepIndex next_step() const { return {now_.value + 1}; }

  /// A step with messages from these others.
  coordination::Report step(const std::vector<coordination::Traffic>& traffic = {},
                            const std::vector<coordination::Prediction>& predictions = {}) {
    ++now_.value;
    controller::Observation observation{.step = now_,
                                        .active = {{2}},
                                        .states = {controller::on_its_plan(*controller_, now_)},
                                        .present = {}};
    for (const coordination::Traffic& other : traffic) observation.active.push_back(other.vehicle);
    observation.present = observation.active;
    static_cast<void>(controller_->observe(observation));
    controller_->couple(traffic);
    static_cast<void>(controller_->plan(predictions));
    return controller_->commit(predictions, {});
  }

 private:
  DrivenController(std::unique_ptr<controller::Controller> controller, StepIndex now)
      : controller_(std::move(controller)), now_(now) {}

  std::unique_ptr<controller::Controller> controller_;
  StepIndex now_{100};
};

}  // namespace hlc::test
