#include "vehicle_sim/campaign/tradeoff_front.hpp"

#include <utility>

namespace hlc::campaign {
namespace {

std::vector<maneuver_design::Objectives> values_of(const std::vector<TradeoffPoint>& points) {
  std::vector<maneuver_design::Objectives> values;
  for (const TradeoffPoint& point : points) values.push_back(point.values);
  return values;
}

}  // namespace

maneuver_design::Objectives reference_of(const std::vector<TradeoffPoint>& points) {
  return kReferenceFactor * maneuver_design::range_of(values_of(points)).worst;
}

TradeoffFront front_of(const std::vector<TradeoffPoint>& points,
                       const maneuver_design::Objectives& reference) {
  std::vector<maneuver_design::Objectives> fixed;
  for (const TradeoffPoint& point : points) {
    if (!point.is_policy) fixed.push_back(point.values);
  }
  TradeoffFront front{.not_dominated = maneuver_design::non_dominated(values_of(points)),
                      .fixed_volume = maneuver_design::hypervolume(fixed, reference),
                      .volume_with = {}};
  for (const TradeoffPoint& point : points) {
    std::vector<maneuver_design::Objectives> with = fixed;
    with.push_back(point.values);
    front.volume_with.push_back(maneuver_design::hypervolume(std::move(with), reference));
  }
  return front;
}

}  // namespace hlc::campaign
