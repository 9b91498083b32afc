#include "vehicle_sim/apps/evaluation_series.hpp"

#include <exception>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "hlc_bridge/messages/exit_codes.hpp"
#include "planner/common/text_file.hpp"
#include "planner/plot/scenario_data.hpp"
#include "vehicle_sim/apps/clocks.hpp"
#include "vehicle_sim/apps/missing_runs.hpp"
#include "vehicle_sim/campaign/run_series.hpp"

namespace hlc::apps {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

struct WrittenRun {
  std::string fault;
  campaign::RunSeries rows;
};

bool is_same_way(const scenario::ScenarioVehicle& a, const scenario::ScenarioVehicle& b) {
  return a.id == b.id && a.path.points_m() == b.path.points_m();
}

class SeriesOfRuns {
 public:
  explicit SeriesOfRuns(const campaign::Campaign& campaign)
      : campaign_(campaign), runs_(campaign.runs().size()) {}

  void drive(std::size_t jobs) {
    std::vector<std::size_t> own;
    std::vector<std::size_t> others;
    for (std::size_t i = 0; i < runs_.size(); ++i) {
      const std::size_t start = campaign_.runs()[i].start;
      if (start < kMostStartsInSeries) (start == 0 ? own : others).push_back(i);
    }
    for_each_number(own, "series of run", 1, [this](std::size_t i) { drive_one(i); });
    if (others.empty()) return;
    for_each_number(others, "series of run", jobs, [this](std::size_t i) { drive_one(i); });
  }

  void write(const fs::path& folder) const {
    fs::create_directories(folder);
    write_rows(folder / "steps.csv", campaign::kStepColumns, &campaign::RunSeries::steps);
    write_rows(folder / "drives.csv", campaign::kDriveColumns, &campaign::RunSeries::drives);
    write_rows(folder / "distances.csv", campaign::kDistanceColumns,
               &campaign::RunSeries::distances);
    write_file(folder / "places.json", places().dump(1) + "\n");
  }

 private:
  void drive_one(std::size_t i) {
    // Why a run cannot be driven is in the campaign's own rows.
    try {
      const campaign::DrivenRun run = campaign_.drive(i, machine_clocks());
      if (!is_driven_to_end(run.experiment.facts.exit_code)) return;
      const campaign::CampaignRun& what = campaign_.runs()[i];
      const bool is_own = what.start == 0;
      if (!is_own && !is_same_way(run.scenario.vehicles.front(),
                                  campaign_.scenario_of(what).vehicles.front())) {
        return;
      }
      runs_[i] = WrittenRun{.fault = campaign_.result_of(run).fault,
                            .rows = series_of(run, i, campaign_.heading_of(i),
                                              is_own ? campaign::SeriesExtent::kWhole
                                                     : campaign::SeriesExtent::kFirstVehicle)};
    } catch (const std::exception&) {
      return;
    }
  }

  void write_rows(const fs::path& file, const char* columns,
                  std::string campaign::RunSeries::*rows) const {
    std::string text = columns;
    for (const std::optional<WrittenRun>& run : runs_) {
      if (run) text += run->rows.*rows;
    }
    write_file(file, text);
  }

  [[nodiscard]] Json places() const {
    Json json{{"scenarios", Json::array()}, {"runs", Json::array()}};
    std::set<std::string> known;
    for (std::size_t i = 0; i < runs_.size(); ++i) {
      const campaign::CampaignRun& run = campaign_.runs()[i];
      const scenario::Scenario& scenario = campaign_.scenario_of(run);
      if (known.insert(scenario.name).second)
        json["scenarios"].push_back(plot::scenario_data(scenario));
      if (!runs_[i]) continue;
      const campaign::RunFigures heading = campaign_.heading_of(i);
      json["runs"].push_back({{"run", i},
                              {"scenario", heading.scenario},
                              {"profile", heading.profile},
                              {"subgraph", heading.subgraph},
                              {"policy", heading.policy},
                              {"start", heading.start},
                              {"fault", runs_[i]->fault}});
    }
    return json;
  }

  const campaign::Campaign& campaign_;
  std::vector<std::optional<WrittenRun>> runs_;  ///< none: left out
};

}  // namespace

void write_series(const campaign::Campaign& campaign, std::size_t jobs, const fs::path& folder) {
  SeriesOfRuns series(campaign);
  series.drive(jobs);
  series.write(folder);
}

}  // namespace hlc::apps
