#include "planner/controller/two_rounds.hpp"

#include <algorithm>

#include "planner/common/word_hash.hpp"
#include "planner/coordination/digest.hpp"

namespace hlc::controller {
namespace {

/// Of the traffic of all vehicles that the controller knows in this step.
std::uint64_t digest_of_inputs(const Controller& own) {
  WordHash hash;
  for (const VehicleId vehicle : own.coupling().vehicles()) {
    hash.add(coordination::digest_of(own.traffic_of(vehicle)));
  }
  return hash.value();
}

}  // namespace

bool TwoRounds::offers(const Controller& own, const coordination::Traffic& traffic) {
  is_chosen_ = false;
  is_offered_ = shares() && joint_.can_be_planned_for(own, traffic);
  return is_offered_;
}

void TwoRounds::choose(const Controller& own) {
  computed_ = {};
  not_shared_.clear();
  if (!shares()) return;
  not_shared_ = is_offered_ ? joint_.prepare(own) : std::vector<VehicleId>{own.options().vehicle};
  is_chosen_ = not_shared_.empty();
}

coordination::Outcome TwoRounds::plan(Controller& own) {
  computed_ = joint_.plan(own);
  inputs_ = digest_of_inputs(own);
  return {.vehicle = own.options().vehicle,
          .step = own.last_step(),
          .digests = coordination::PlanDigests{
              .inputs = inputs_,
              .plan = coordination::digest_of(own.prediction()),
              .is_prediction_published = is_prediction_needed_ || !own.missing().empty()}};
}

coordination::ReceivedMessages<coordination::Prediction> TwoRounds::known_plans(
    Controller& own, const coordination::ReceivedMessages<coordination::Prediction>& predictions,
    const coordination::ReceivedMessages<coordination::Outcome>& outcomes) {
  coordination::ReceivedMessages<coordination::Prediction> known;
  is_prediction_needed_ = false;
  for (const VehicleId other : own.coupled()) {
    const auto computed = computed_.find(other, own.last_step());
    const std::uint64_t digest = coordination::digest_of(*computed);
    const auto outcome = outcomes.find(other, own.last_step());
    const auto prediction = predictions.find(other, own.last_step());
    const bool has_digests = outcome != nullptr && outcome->digests;
    bool is_same = prediction != nullptr && coordination::digest_of(*prediction) == digest;
    if (has_digests) {
      is_same = outcome->digests->plan == digest;
      compare(other, is_same, *outcome->digests, own);
    }
    if (!is_same || !has_digests) is_prediction_needed_ = true;
    if (!is_same) own.disregard(other);
    if (is_same) {
      known.put(computed);
    } else if (prediction != nullptr) {
      known.put(prediction);
    }
  }
  return known;
}

/// A vehicle that is missing counts with what each controller has seen of it before: then the
/// inputs are more than the traffic.
void TwoRounds::compare(VehicleId vehicle, bool is_same, const coordination::PlanDigests& received,
                        const Controller& own) {
  if (is_same || received.inputs != inputs_ || !own.missing().empty()) return;
  RecentSteps& steps = differing_steps_[vehicle];
  steps.add(own.last_step());
  if (steps.count() >= own.options().horizon_steps && !differs_from_) differs_from_ = vehicle;
}

void TwoRounds::end_late(Controller& own) {
  for (const VehicleId other : own.coupled()) own.disregard(other);
  late_steps_.add(own.last_step());
  if (late_steps_.count() >= kMostLateSteps) is_too_slow_ = true;
}

void TwoRounds::RecentSteps::add(StepIndex step) {
  std::erase_if(steps_, [&](StepIndex before) { return before.value + kWindow <= step.value; });
  steps_.push_back(step);
}

}  // namespace hlc::controller
