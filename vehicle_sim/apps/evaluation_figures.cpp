#include "vehicle_sim/apps/evaluation_figures.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>

#include "hlc_bridge/messages/exit_codes.hpp"
#include "planner/common/text_file.hpp"
#include "planner/maneuver_design/automaton_builder.hpp"
#include "planner/maneuver_design/automaton_configuration.hpp"
#include "planner/maneuver_design/built_automaton.hpp"
#include "planner/maneuver_design/criteria.hpp"
#include "planner/plot/automaton_plot.hpp"
#include "planner/plot/pareto_plot.hpp"
#include "planner/plot/scenario_plot.hpp"
#include "vehicle_sim/campaign/figure_parts.hpp"
#include "vehicle_sim/campaign/figures.hpp"

namespace hlc::apps {
namespace {

namespace fs = std::filesystem;

/// The maneuver of the paper's Fig. 1.
constexpr automaton::Trim kParetoFrom{};
constexpr automaton::Trim kParetoTo{.speed_mps = 2.3, .steering_rad = 0.62};
constexpr std::size_t kParetoPoints = 31;

std::string pareto_set(const fs::path& configuration) {
  const maneuver_design::AutomatonConfiguration c =
      maneuver_design::read_automaton_configuration(configuration);
  maneuver_design::ParetoProblem problem{
      .maneuver = maneuver_design::problem_between(kParetoFrom, kParetoTo, c)};
  const plot::ParetoDescription description{
      kParetoFrom, kParetoTo, problem.maneuver.duration_s, {"J1", "J2"}};
  for (const std::string& name : description.criteria) {
    problem.criteria.push_back(maneuver_design::make_criterion(name, c.vehicle));
  }
  const maneuver_design::ParetoOptions options{.points = kParetoPoints};
  const maneuver_design::ParetoFront front =
      maneuver_design::epsilon_constraint_front(problem, options);
  if (front.status != maneuver_design::ManeuverStatus::kOptimal) {
    throw std::runtime_error(configuration.string() + ": " + front.reason);
  }
  return plot::pareto_plot(front, maneuver_design::weighted_sum_front(problem, options),
                           description);
}

/// The whole automaton; a scenario holds only the part that its subgraph needs.
std::string automaton(const fs::path& file) {
  if (automaton::is_automaton_file(file))
    return plot::automaton_plot(maneuver_design::read_current_automaton_file(file));
  const maneuver_design::AutomatonConfiguration configuration =
      maneuver_design::read_automaton_configuration(file);
  return plot::automaton_plot(
      maneuver_design::file_of(configuration, maneuver_design::build_automaton(configuration)));
}

using RunsFigure = std::string (*)(std::span<const campaign::DrivenRun>,
                                   const std::optional<road::LaneletMap>&);

/// Figures that need driven runs.
const std::vector<std::pair<std::string, RunsFigure>>& runs_figures() {
  static const std::vector<std::pair<std::string, RunsFigure>> figures{
      {"paths", campaign::paths_figure},
      {"error", [](auto runs, const auto&) { return campaign::error_figure(runs); }},
      {"vertices", [](auto runs, const auto&) { return campaign::vertices_figure(runs); }},
      {"planning_time",
       [](auto runs, const auto&) { return campaign::planning_time_figure(runs); }},
      {"distance", [](auto runs, const auto&) { return campaign::distance_figure(runs); }},
      {"subgraphs", [](auto runs, const auto&) { return campaign::subgraphs_figure(runs); }}};
  return figures;
}

class Drawing {
 public:
  Drawing(const campaign::Campaign& campaign, const FigureChoices& choices, fs::path folder)
      : campaign_(campaign), choices_(choices), folder_(std::move(folder)) {
    fs::create_directories(folder_);
  }

  std::vector<fs::path> draw() {
    if (is_wanted("pareto_set")) {
      choices_.log("the Pareto set of Fig. 1");
      write("pareto_set", pareto_set(choices_.pareto_configuration));
    }
    std::map<std::string, fs::path>
        automata;  // by name; automata of one name are distinguished by the scenario
    std::set<std::string> drawn;
    std::set<fs::path> scenarios;
    for (const campaign::CampaignRun& run : campaign_.runs()) {
      const scenario::Scenario& scenario = campaign_.scenario_of(run);
      const std::string name = run.scenario.stem().string();
      const std::string stem = scenario.automaton_file.stem().string();
      const fs::path& first = automata.try_emplace(stem, scenario.automaton_file).first->second;
      const std::string figure = first == scenario.automaton_file ? stem : stem + "_of_" + name;
      if (is_wanted("automaton") && drawn.insert(figure).second) {
        choices_.log("the automaton of " + name);
        write("automaton_" + figure, automaton(scenario.automaton_file));
      }
      if (is_wanted("scenario") && scenarios.insert(run.scenario).second) {
        write("scenario_" + name, plot::scenario_plot(scenario, plot::map_of(scenario)));
      }
    }
    if (std::ranges::any_of(runs_figures(),
                            [&](const auto& figure) { return is_wanted(figure.first); })) {
      draw_runs();
    }
    return written_;
  }

 private:
  [[nodiscard]] bool is_wanted(const std::string& name) const {
    return std::ranges::find(choices_.names, name) != choices_.names.end();
  }

  void write(const std::string& name, const std::string& svg) {
    written_.push_back(folder_ / (name + ".svg"));
    write_file(written_.back(), svg);
  }

  /// Numbers of the runs with the first start, by scenario and profile.
  [[nodiscard]] std::map<std::pair<fs::path, std::string>, std::vector<std::size_t>> groups()
      const {
    std::map<std::pair<fs::path, std::string>, std::vector<std::size_t>> groups;
    for (std::size_t i = 0; i < campaign_.runs().size(); ++i) {
      const campaign::CampaignRun& run = campaign_.runs()[i];
      if (run.start == 0) groups[{run.scenario, run.profile}].push_back(i);
    }
    return groups;
  }

  void draw_runs() {
    for (const auto& [group, numbers] : groups()) {
      const std::string name = group.first.stem().string() + "_" + group.second;
      choices_.log("the runs of " + name);
      std::vector<campaign::DrivenRun> runs;
      for (const std::size_t i : numbers) {
        // A failed run is recorded with its reason among the campaign's.
        try {
          campaign::DrivenRun run = campaign_.drive(i, choices_.clocks);
          if (!is_driven_to_end(run.experiment.facts.exit_code)) continue;
          if (const std::string fault = campaign_.result_of(run).fault; !fault.empty()) {
            choices_.log("among them " + campaign::run_name(run) +
                         ", which does not count: " + fault);
          }
          runs.push_back(std::move(run));
        } catch (const std::exception&) {
          continue;
        }
      }
      if (runs.empty()) continue;
      const std::optional<road::LaneletMap> map = plot::map_of(runs.front().scenario);
      for (const auto& [figure, draw] : runs_figures()) {
        if (!is_wanted(figure)) continue;
        if (figure == "distance" && runs.front().scenario.vehicles.size() < 2) continue;
        write(figure + "_" + name, draw(runs, map));
      }
    }
  }

  const campaign::Campaign& campaign_;
  const FigureChoices& choices_;
  fs::path folder_;
  std::vector<fs::path> written_;
};

}  // namespace

const std::vector<std::string>& figure_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all{"pareto_set", "automaton", "scenario"};
    for (const auto& [name, draw] : runs_figures()) all.push_back(name);
    return all;
  }();
  return names;
}

void check_figures(const FigureChoices& choices) {
  if (std::ranges::find(choices.names, "pareto_set") != choices.names.end()) {
    static_cast<void>(maneuver_design::read_automaton_configuration(choices.pareto_configuration));
  }
}

std::vector<fs::path> draw_figures(const campaign::Campaign& campaign, const FigureChoices& choices,
                                   const fs::path& folder) {
  return Drawing(campaign, choices, folder).draw();
}

}  // namespace hlc::apps
