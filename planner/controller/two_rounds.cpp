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

bool TwoRounds::begin(const Controller& own) {
  computed_ = {};
  not_shared_.clear();
  is_begun_ = false;
  if (!shares()) return false;
  not_shared_ = joint_.prepare(own);
  is_begun_ = not_shared_.empty();
  return is_begun_;
}

coordination::Outcome TwoRounds::plan(Controller& own) {
  computed_ = joint_.plan(own);
  inputs_ = digest_of_inputs(own);
  return {.vehicle = own.options().vehicle,
          .step = own.last_step(),
          .digests = coordination::PlanDigests{.inputs = inputs_,
                                               .plan = coordination::digest_of(own.prediction())}};
}

coordination::ReceivedMessages<coordination::Prediction> TwoRounds::known_plans(
    Controller& own, const coordination::ReceivedMessages<coordination::Prediction>& predictions,
    const coordination::ReceivedMessages<coordination::Outcome>& outcomes) {
  coordination::ReceivedMessages<coordination::Prediction> known;
  for (const VehicleId other : own.coupled()) {
    const auto computed = computed_.find(other, own.last_step());
    const std::uint64_t digest = coordination::digest_of(*computed);
    const auto outcome = outcomes.find(other, own.last_step());
    const auto prediction = predictions.find(other, own.last_step());
    bool is_same = prediction != nullptr && coordination::digest_of(*prediction) == digest;
    if (outcome != nullptr && outcome->digests) {
      is_same = outcome->digests->plan == digest;
      compare(other, is_same, *outcome->digests, own);
    }
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
  const bool is_proof = !is_same && received.inputs == inputs_ && own.missing().empty();
  std::size_t& steps = differing_steps_[vehicle];
  steps = is_proof ? steps + 1 : 0;
  if (steps >= own.options().horizon_steps && !differs_from_) differs_from_ = vehicle;
}

void TwoRounds::note_late(StepIndex step) {
  std::erase_if(late_, [&](StepIndex before) { return before.value + kLateWindow <= step.value; });
  late_.push_back(step);
  if (late_.size() >= kMostLateSteps) is_too_slow_ = true;
}

}  // namespace hlc::controller
