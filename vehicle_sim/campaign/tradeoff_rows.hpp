#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "vehicle_sim/campaign/run_figures.hpp"
#include "vehicle_sim/campaign/tradeoff_front.hpp"

/// Parts of the tables of tradeoff.hpp.
namespace hlc::campaign {

/// A column.
struct TradeoffQuantity {
  std::string name;  ///< with its unit
  std::string key;   ///< in comma-separated values
  int decimals;
  std::optional<double> (*of)(const RunFigures&);
};

[[nodiscard]] const std::vector<TradeoffQuantity>& tradeoff_quantities();

/// Two columns to trade off, by their indices.
struct TradeoffPair {
  std::size_t x;
  std::size_t y;
};

[[nodiscard]] const std::vector<TradeoffPair>& tradeoff_pairs();
[[nodiscard]] std::string name_of(const TradeoffPair& pair);

/// The runs on one fixed subgraph or with one policy.
struct TradeoffRow {
  std::vector<const RunFigures*> runs;
  std::vector<std::optional<double>> medians;  ///< of tradeoff_quantities()
  std::size_t laps{};                          ///< runs that count, with a lap
  std::size_t good_runs{};                     ///< runs that count
  bool keeps_limits{true};                     ///< kMostAboveLimit

  [[nodiscard]] const RunFigures& first() const { return *runs.front(); }
};

/// The rows of one scenario and profile, in the order of their appearance.
struct TradeoffGroup {
  std::string scenario;
  std::string profile;
  std::vector<TradeoffRow> rows;
  bool has_zones{};  ///< a vehicle entered a zone
};

/// The rows point into the runs.
[[nodiscard]] std::vector<TradeoffGroup> tradeoff_groups(const std::vector<RunFigures>& runs);

/// Competition of some rows in two columns.
struct TradeoffCompetition {
  std::vector<const TradeoffRow*> rows;   ///< those with both values
  maneuver_design::Objectives reference;  ///< of all rows with values, also those left out
  TradeoffFront front;
};

/// @param within_limits  only rows that keep the limits
/// @return nothing without competing rows
[[nodiscard]] std::optional<TradeoffCompetition> competition(const TradeoffGroup& group,
                                                             const TradeoffPair& pair,
                                                             bool within_limits);

}  // namespace hlc::campaign
