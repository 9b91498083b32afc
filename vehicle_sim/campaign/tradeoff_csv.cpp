#include <algorithm>

#include "planner/common/csv.hpp"
#include "vehicle_sim/campaign/number_text.hpp"
#include "vehicle_sim/campaign/tradeoff.hpp"
#include "vehicle_sim/campaign/tradeoff_rows.hpp"

namespace hlc::campaign {

std::string tradeoff_csv(const std::vector<RunFigures>& runs) {
  std::string text = "scenario,profile,subgraph,policy";
  for (const TradeoffQuantity& quantity : tradeoff_quantities()) text += "," + quantity.key;
  text += ",keeps_limits,laps,good_runs,runs\n";
  for (const TradeoffGroup& group : tradeoff_groups(runs)) {
    for (const TradeoffRow& row : group.rows) {
      CsvLine line(group.scenario, group.profile, row.first().subgraph, row.first().policy);
      for (const std::optional<double>& median : row.medians) line.add(number(median, 6, ""));
      line.add(row.keeps_limits, row.laps, row.good_runs, row.runs.size());
      text += line.text();
    }
  }
  return text;
}

std::string tradeoff_fronts_csv(const std::vector<RunFigures>& runs) {
  std::string text =
      "scenario,profile,rows,x,y,reference_x,reference_y,subgraph,policy,not_dominated,fixed,"
      "with\n";
  for (const TradeoffGroup& group : tradeoff_groups(runs)) {
    for (const bool within_limits : {false, true}) {
      for (const TradeoffPair& pair : tradeoff_pairs()) {
        const std::optional<TradeoffCompetition> one = competition(group, pair, within_limits);
        if (!one) continue;
        const CsvLine begin(group.scenario, group.profile, within_limits ? "within_limits" : "all",
                            tradeoff_quantities()[pair.x].key, tradeoff_quantities()[pair.y].key,
                            number(one->reference(0), 6), number(one->reference(1), 6));
        for (std::size_t i = 0; i < one->rows.size(); ++i) {
          const RunFigures& first = one->rows[i]->first();
          const bool is_in_front = std::ranges::binary_search(one->front.not_dominated, i);
          CsvLine line = begin;
          line.add(first.subgraph, first.policy, is_in_front, number(one->front.fixed_volume, 6),
                   number(one->front.volume_with[i], 6));
          text += line.text();
        }
      }
    }
  }
  return text;
}

}  // namespace hlc::campaign
