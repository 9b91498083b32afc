#include "vehicle_sim/apps/evaluation_results.hpp"

#include <nlohmann/json.hpp>

#include "planner/common/text_file.hpp"
#include "vehicle_sim/apps/figures_record.hpp"
#include "vehicle_sim/campaign/tradeoff.hpp"

namespace hlc::apps {

using Json = nlohmann::ordered_json;

const std::vector<std::string>& result_files() {
  static const std::vector<std::string> kNames{"results.json", "table.md",
                                               "table.csv",    "tradeoff.md",
                                               "tradeoff.csv", "tradeoff_fronts.csv"};
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

void write_results(const RunLog& log, const campaign::EvaluationOrigin& origin) {
  Json results;
  results["campaign"] = Json::parse(log.heading());
  results["runs"] = Json::array();
  for (const auto& [run, line] : log.records()) results["runs"].push_back(Json::parse(line));
  write_file(log.folder() / "results.json", results.dump(1) + "\n");
  const std::vector<campaign::RunFigures> runs = figures_of_rows(log);
  write_file(log.folder() / "table.md", campaign::evaluation_markdown(runs, origin));
  write_file(log.folder() / "table.csv", campaign::evaluation_csv(runs));
  if (results["campaign"].at("policies").empty()) return;
  write_file(log.folder() / "tradeoff.md", campaign::tradeoff_markdown(runs));
  write_file(log.folder() / "tradeoff.csv", campaign::tradeoff_csv(runs));
  write_file(log.folder() / "tradeoff_fronts.csv", campaign::tradeoff_fronts_csv(runs));
}

}  // namespace hlc::apps
