// Requests for another subgraph, and their answers.
#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "hlc_bridge/dds/convert_hlc.hpp"

// The structured bindings name every field of a plain message, so that a new field does not compile
// until it is converted.
namespace hlc::dds {
namespace {

// Without a default case: a new enumerator does not compile until it is known here.
bool is_known(RequestOutcome outcome) {
  switch (outcome) {
    case RequestOutcome::kAccepted:
    case RequestOutcome::kInForce:
    case RequestOutcome::kRefused:
    case RequestOutcome::kStale:
      return true;
  }
  return false;
}

std::vector<std::uint32_t> trims_to_wire(const std::vector<TrimId>& trims) {
  std::vector<std::uint32_t> wire;
  for (const TrimId trim : trims) wire.push_back(static_cast<std::uint32_t>(trim.index));
  return wire;
}

std::vector<TrimId> trims_from_wire(const std::vector<std::uint32_t>& wire) {
  std::vector<TrimId> trims;
  for (const std::uint32_t trim : wire) trims.push_back({trim});
  return trims;
}

std::vector<EdgeMessage> edges_to_wire(const std::vector<TrimPair>& edges) {
  std::vector<EdgeMessage> wire(edges.size());
  for (std::size_t i = 0; i < edges.size(); ++i) {
    wire[i].from(static_cast<std::uint32_t>(edges[i].from.index));
    wire[i].to(static_cast<std::uint32_t>(edges[i].to.index));
  }
  return wire;
}

std::vector<TrimPair> edges_from_wire(const std::vector<EdgeMessage>& wire) {
  std::vector<TrimPair> edges;
  for (const EdgeMessage& edge : wire) edges.push_back({{edge.from()}, {edge.to()}});
  return edges;
}

std::vector<CriterionWeightMessage> weights_to_wire(const std::vector<CriterionWeight>& weights) {
  std::vector<CriterionWeightMessage> wire(weights.size());
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const auto& [criterion, weight] = weights[i];
    wire[i].criterion(criterion);
    wire[i].weight(weight);
  }
  return wire;
}

std::vector<CriterionWeight> weights_from_wire(const std::vector<CriterionWeightMessage>& wire) {
  std::vector<CriterionWeight> weights;
  for (const CriterionWeightMessage& one : wire) weights.push_back({one.criterion(), one.weight()});
  return weights;
}

bool is_valid_request(const AutomatonRequestMessage& wire) {
  const auto is_short = [](const auto& entries) { return entries.size() <= kMaxEntries; };
  return is_valid(VehicleId{wire.vehicle_id()}) && all_finite(wire.max_speed_mps()) &&
         is_short(wire.labels()) && is_short(wire.weights()) && is_short(wire.enable_trims()) &&
         is_short(wire.disable_trims()) && is_short(wire.enable_edges()) &&
         is_short(wire.disable_edges()) &&
         std::ranges::all_of(wire.labels(),
                             [](const std::string& label) { return label.size() <= kMaxText; }) &&
         std::ranges::all_of(wire.weights(), [](const CriterionWeightMessage& one) {
           return one.criterion().size() <= kMaxText && all_finite(one.weight());
         });
}

}  // namespace

bool can_be_written(const AutomatonRequest& message) { return is_valid(message.vehicle); }
bool can_be_written(const AutomatonAnswer& message) { return is_valid(message.vehicle); }

void to_wire(const AutomatonRequest& message, AutomatonRequestMessage& wire) {
  const auto& [vehicle, id, valid_from, subgraph] = message;
  const auto& [labels, weights, max_speed_mps, enable_trims, disable_trims, enable_edges,
               disable_edges] = subgraph;
  wire.vehicle_id(vehicle.value);
  wire.id(id);
  wire.valid_from(valid_from);
  wire.labels(labels);
  wire.weights(weights_to_wire(weights));
  wire.limits_speed(max_speed_mps.has_value());
  wire.max_speed_mps(max_speed_mps.value_or(0.0));
  wire.enable_trims(trims_to_wire(enable_trims));
  wire.disable_trims(trims_to_wire(disable_trims));
  wire.enable_edges(edges_to_wire(enable_edges));
  wire.disable_edges(edges_to_wire(disable_edges));
}

Incoming<AutomatonRequest> from_wire(const AutomatonRequestMessage& wire) {
  if (!is_valid_request(wire)) {
    return {std::nullopt, 1};
  }
  SubgraphRequest subgraph{.labels = wire.labels(),
                           .weights = weights_from_wire(wire.weights()),
                           .max_speed_mps = {},
                           .enable_trims = trims_from_wire(wire.enable_trims()),
                           .disable_trims = trims_from_wire(wire.disable_trims()),
                           .enable_edges = edges_from_wire(wire.enable_edges()),
                           .disable_edges = edges_from_wire(wire.disable_edges())};
  if (wire.limits_speed()) subgraph.max_speed_mps = wire.max_speed_mps();
  return {AutomatonRequest{.vehicle = {wire.vehicle_id()},
                           .id = wire.id(),
                           .valid_from = wire.valid_from(),
                           .subgraph = std::move(subgraph)},
          0};
}

void to_wire(const AutomatonAnswer& message, AutomatonAnswerMessage& wire) {
  const auto& [vehicle, id, outcome, step, text] = message;
  wire.vehicle_id(vehicle.value);
  wire.id(id);
  wire.outcome(static_cast<std::uint8_t>(outcome));
  wire.step(step.value);
  wire.text(text);
}

Incoming<AutomatonAnswer> from_wire(const AutomatonAnswerMessage& wire) {
  const auto outcome = static_cast<RequestOutcome>(wire.outcome());
  return valid_if(
      is_valid(VehicleId{wire.vehicle_id()}) && is_known(outcome) && wire.text().size() <= kMaxText,
      AutomatonAnswer{.vehicle = {wire.vehicle_id()},
                      .id = wire.id(),
                      .outcome = outcome,
                      .step = {wire.step()},
                      .text = wire.text()});
}

}  // namespace hlc::dds
