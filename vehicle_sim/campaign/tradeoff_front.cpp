#include "vehicle_sim/campaign/tradeoff_front.hpp"

#include <utility>

namespace hlc {
namespace {

std::vector<Objectives> values_of(const std::vector<TradeoffPoint>& points) {
  std::vector<Objectives> values;
  for (const TradeoffPoint& point : points) values.push_back(point.values);
  return values;
}

}  // namespace

Objectives reference_of(const std::vector<TradeoffPoint>& points) {
  return kReferenceFactor * range_of(values_of(points)).worst;
}

TradeoffFront front_of(const std::vector<TradeoffPoint>& points, const Objectives& reference) {
  std::vector<Objectives> fixed;
  for (const TradeoffPoint& point : points) {
    if (!point.is_policy) fixed.push_back(point.values);
  }
  TradeoffFront front{.not_dominated = non_dominated(values_of(points)),
                      .fixed_volume = hypervolume(fixed, reference),
                      .volume_with = {}};
  for (const TradeoffPoint& point : points) {
    std::vector<Objectives> with = fixed;
    with.push_back(point.values);
    front.volume_with.push_back(hypervolume(std::move(with), reference));
  }
  return front;
}

}  // namespace hlc
