#include "vehicle_sim/apps/evaluation_results.hpp"

#include <nlohmann/json.hpp>

#include "planner/common/text_file.hpp"
#include "vehicle_sim/apps/figures_record.hpp"
#include "vehicle_sim/apps/row_tables.hpp"

namespace hlc::apps {

using Json = nlohmann::ordered_json;

const std::vector<std::string>& result_files() {
  static const std::vector<std::string> kNames{"campaign.json", "runs.csv", "cars.csv"};
  return kNames;
}

campaign::RunFigures figures_of_row(const Json& row) {
  return figures_of_record(row, {.scenario = row.at("scenario").get<std::string>(),
                                 .profile = row.at("profile").get<std::string>(),
                                 .subgraph = row.at("subgraph").get<std::string>(),
                                 .policy = row.at("policy").get<std::string>(),
                                 .start = row.at("start").get<std::size_t>()});
}

std::vector<campaign::RunFigures> figures_of_rows(const RunLog& log) {
  std::vector<campaign::RunFigures> figures;
  for (const auto& [run, line] : log.records())
    figures.push_back(figures_of_row(Json::parse(line)));
  return figures;
}

void write_results(const RunLog& log, const EvaluationOrigin& origin) {
  std::vector<RunRow> runs;
  std::vector<Json> records;
  for (const auto& [run, line] : log.records()) {
    records.push_back(Json::parse(line));
    runs.push_back({.run = run,
                    .settings = {},
                    .figures = figures_of_row(records.back()),
                    .was_driven = records.back().contains("figures")});
  }
  write_file(log.folder() / "runs.csv", runs_csv({}, runs, true));
  write_file(log.folder() / "cars.csv", cars_csv(records));
  write_file(log.folder() / "campaign.json",
             campaign_json("campaign", origin, Json::parse(log.heading())));
}

}  // namespace hlc::apps
