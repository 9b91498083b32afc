#include "vehicle_sim/campaign/tradeoff.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "vehicle_sim/campaign/markdown_table.hpp"
#include "vehicle_sim/campaign/number_text.hpp"
#include "vehicle_sim/campaign/tradeoff_rows.hpp"
#include "vehicle_sim/campaign/zone_excess.hpp"

namespace hlc::campaign {
namespace {

std::string cell_of(const std::string& name) {
  std::string cell;
  for (const char c : name) cell += c == '|' ? "\\|" : std::string(1, c);
  return cell;
}

std::string table_of(const TradeoffGroup& group) {
  std::vector<std::string> titles{""};
  for (const TradeoffQuantity& quantity : tradeoff_quantities()) titles.push_back(quantity.name);
  titles.insert(titles.end(), {"laps", "runs that count / all"});
  std::string text = markdown_heading(titles);
  for (const TradeoffRow& row : group.rows) {
    std::vector<std::string> cells{cell_of(planned_on(row.first())) +
                                   (row.keeps_limits ? "" : " (!)")};
    for (std::size_t i = 0; i < row.medians.size(); ++i) {
      cells.push_back(number(row.medians[i], tradeoff_quantities()[i].decimals, "-"));
    }
    cells.insert(cells.end(), {fmt::to_string(row.laps),
                               fmt::format("{} / {}", row.good_runs, row.runs.size())});
    text += markdown_row(cells);
  }
  return text + "\n";
}

/// Means over the runs with a lap.
std::string uses_of(const TradeoffGroup& group) {
  std::string text;
  for (const TradeoffRow& row : group.rows) {
    if (!has_policy(row.first()) || row.laps == 0) continue;
    std::map<std::string, double> shares;
    for (const RunFigures* run : row.runs) {
      if (!has_lap(*run)) continue;
      for (const auto& [name, share] : run->subgraph_shares) {
        shares[name] += share / static_cast<double>(row.laps);
      }
    }
    std::vector<std::pair<std::string, double>> sorted(shares.begin(), shares.end());
    std::ranges::stable_sort(sorted, std::ranges::greater{},
                             [](const auto& one) { return one.second; });
    text += "* " + planned_on(row.first()) + ":";
    for (const auto& [name, share] : sorted) {
      text += fmt::format("{}{} {:.1f} %", name == sorted.front().first ? " " : "; ", name,
                          100.0 * share);
    }
    text += "\n";
  }
  return text.empty() ? "" : "Shares of the steps, by what was planned on:\n\n" + text + "\n";
}

std::string front_names(const TradeoffCompetition& competition) {
  std::vector<std::string> names;
  for (const std::size_t i : competition.front.not_dominated) {
    names.push_back(cell_of(planned_on(competition.rows[i]->first())));
  }
  return fmt::format("{}", fmt::join(names, ", "));
}

/// "1.052": with the policy, of the fixed ones; absolute if these have none.
std::string volume_text(const TradeoffFront& front, std::size_t i) {
  if (front.fixed_volume > 0.0) return number(front.volume_with[i] / front.fixed_volume, 3);
  return number(front.volume_with[i], 3) + " (of none)";
}

std::string fronts_of(const TradeoffGroup& group, bool within_limits) {
  std::vector<std::string> titles{"", "not dominated", "hypervolume of the fixed"};
  std::vector<const TradeoffRow*> policies;
  for (const TradeoffRow& row : group.rows) {
    if (!has_policy(row.first())) continue;
    policies.push_back(&row);
    titles.push_back("with " + cell_of(planned_on(row.first())));
  }
  std::string text = markdown_heading(titles);
  for (const TradeoffPair& pair : tradeoff_pairs()) {
    const std::optional<TradeoffCompetition> one = competition(group, pair, within_limits);
    std::vector<std::string> cells(titles.size(), "-");
    cells[0] = name_of(pair);
    if (one) {
      cells[1] = front_names(*one);
      cells[2] = number(one->front.fixed_volume, 3);
      for (std::size_t i = 0; i < policies.size(); ++i) {
        const auto row = std::ranges::find(one->rows, policies[i]);
        if (row == one->rows.end()) continue;
        cells[3 + i] = volume_text(one->front, static_cast<std::size_t>(row - one->rows.begin()));
      }
    }
    text += markdown_row(cells);
  }
  return text + "\n";
}

std::string references_of(const TradeoffGroup& group) {
  std::string text =
      "Reference points (" + number(kReferenceFactor, 2) + " times the worst value of all rows):";
  for (const TradeoffPair& pair : tradeoff_pairs()) {
    const std::optional<TradeoffCompetition> one = competition(group, pair, false);
    text += (&pair == &tradeoff_pairs().front() ? " " : "; ") + name_of(pair) + ": ";
    if (!one) {
      text += "-";
      continue;
    }
    text +=
        fmt::format("{:.{}f}, {:.{}f}", one->reference(0), tradeoff_quantities()[pair.x].decimals,
                    one->reference(1), tradeoff_quantities()[pair.y].decimals);
  }
  return text + ".\n\n";
}

std::string markdown_of(const TradeoffGroup& group) {
  std::string text =
      "## " + group.scenario + ", profile " + group.profile + "\n\n" + table_of(group);
  if (group.has_zones) {
    text += fmt::format(
        "(!): does not keep the limits of the zones: in some start clearly above, by more than "
        "{:.1f} m/s, for more than {:.0f} % of the time in zones.\n\n",
        kFollowerExcess_mps, 100.0 * kMostAboveLimit);
  }
  text += uses_of(group) + "### All rows\n\n" + fronts_of(group, false);
  if (group.has_zones) text += "### Rows that keep the limits\n\n" + fronts_of(group, true);
  return text + references_of(group);
}

}  // namespace

std::string tradeoff_markdown(const std::vector<RunFigures>& runs) {
  std::string text =
      "# Fixed subgraphs and policies\n\nMedians over the starts in which the run counts and the "
      "vehicle of highest priority drove a lap. Lap (planned positions) and error (driven "
      "positions to the lane's centre, mean) are that vehicle's, all else is of all vehicles: "
      "effort "
      "J2 and comfort of the driven maneuvers per driven metre, the largest number of generated "
      "vertices of a car in a step, processor time per plan, the share of the time in speed zones "
      "above their limit, in driven speed without tolerance, and switches of the subgraph. "
      "Hypervolumes with a policy are relative to that of the fixed subgraphs: 1 is no gain.\n\n";
  for (const TradeoffGroup& group : tradeoff_groups(runs)) text += markdown_of(group);
  return text;
}

}  // namespace hlc::campaign
