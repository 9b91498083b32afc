// What a controller publishes for others to plan for its vehicle, and how one is put in the place
// of another vehicle's controller.
#include <algorithm>
#include <utility>

#include "planner/common/word_hash.hpp"
#include "planner/controller/controller.hpp"
#include "planner/controller/planning_basis.hpp"
#include "planner/controller/self_loop.hpp"
#include "planner/coordination/plan_by_index.hpp"

namespace hlc::controller {

std::uint64_t Controller::planning_basis() const {
  WordHash hash;
  hash.add(std::uint64_t{options_.vehicle.value});
  hash.add(digest_of(options_));
  hash.add(prepared_subgraph().digest);
  hash.add(routes_digest_);
  if (has_obstacles()) hash.add(digest_of(standing_m_));
  return hash.value();
}

std::optional<coordination::PlanningInput> Controller::planning_input() const {
  // Who misses a vehicle for long plans from what only itself has seen of it.
  const bool misses_any = !step_.traffic.silent.empty();
  // Others may have another state of a guest.
  const bool avoids_guests = !neighbours_.guests().seen().empty();
  if (misses_any || avoids_guests || !path_s_m() || !search_.is_settled()) return std::nullopt;
  std::optional<coordination::PlanningInput> input =
      in_force_->planning_input(step_.observation.step, subgraph().automaton());
  if (!input) return std::nullopt;
  input->basis = planning_basis();
  input->may_plan = may_plan();
  input->route = static_cast<std::uint32_t>(tracker_.index());
  input->path_s_m = *path_s_m();
  input->area = drivable_area_.state();
  return input;
}

bool Controller::resume(const coordination::Traffic& traffic, const Controller& receiver) {
  if (!traffic.planning || !is_well_formed(*traffic.planning, traffic.step)) return false;
  const coordination::PlanningInput& input = *traffic.planning;
  take_obstacles_of(receiver);  // part of the basis
  const auto& automaton = subgraph().shared_automaton();
  if (input.basis != planning_basis() || input.route >= routes().size()) return false;
  const bool has_authority = authority_ && traffic.claim && receiver.authority_;
  const std::uint32_t number = routes()[input.route].number;
  if (authority_.has_value() != traffic.claim.has_value()) return false;
  if (authority_ && (!has_authority || traffic.claim->route != number)) return false;
  std::optional<coordination::Plan> base = coordination::plan_of(input.base, automaton);
  const StepIndex next{traffic.step.value + 1};
  if (!base || base->pose_at(next) != traffic.next_pose ||
      base->trim_at(next) != traffic.next_trim) {
    return false;
  }
  step_ = Step{};
  step_.observation = receiver.step_.observation;
  step_.traffic = traffic;
  step_.report = {.vehicle = options_.vehicle, .step = traffic.step};
  if (!input.may_plan) step_.obstacle = coordination::FallbackReason::kDeviation;
  in_force_.emplace(automaton, self_loop(*automaton, subgraph().standstill()), options_.deviation,
                    *std::move(base), input);
  tracker_.resume(input.route, input.path_s_m);
  drivable_area_.resume(input.area, route());
  neighbours_ = receiver.neighbours_.in_place_of(options_.vehicle, receiver.step_.traffic);
  if (authority_) authority_->resume(*traffic.claim, options_.vehicle, *receiver.authority_);
  take_coupling(receiver.coupling(), receiver.plans_before());
  return true;
}

}  // namespace hlc::controller
