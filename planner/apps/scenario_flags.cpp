#include "planner/apps/scenario_flags.hpp"

#include "planner/apps/flags.hpp"
#include "planner/coordination/priorities/strategies.hpp"
#include "planner/scenario/engine_choice.hpp"
#include "planner/scenario/priority_values.hpp"

namespace hlc::apps {

void declare_scenario_flags(CLI::App& app, scenario::ScenarioChoices& choices) {
  declare_scenario(app, "--scenario", choices.file)->required();
  declare_profile_flag(app, choices.profile);
  app.add_option("--engine", choices.engine,
                 "search engine: " + scenario::engine_choices() +
                     " (default: the scenario's, else the profile's)");
  app.add_option(
         "--priorities", choices.priorities,
         "who plans first (default: the scenario's): " + scenario::priority_strategies_text())
      ->check(among(coordination::priority_strategy_names()));
  app.add_option("--subgraph", choices.subgraph, "instead of the scenario's");
  app.add_option("--policy", choices.policy,
                 "by which the controllers change the subgraph themselves, or none (default: the "
                 "scenario's)");
  app.add_option("--map", choices.map_file, "CommonRoad XML instead of the scenario's")
      ->type_name("FILE");
  app.add_option("--cars", choices.cars,
                 "number of cars (scenarios on a circle, or that draw their cars), instead of the "
                 "scenario's")
      ->check(whole(1, kMaxVehicleId));
  app.add_option("--seed", choices.seed,
                 "of drawn cars and random routes (default: the scenario's)")
      ->check(whole(0, scenario::kMaxSeed));
  app.add_option("--routes", choices.routes,
                 "random: every car takes random turns forever, instead of the scenario's routes")
      ->check(among({scenario::kRandomRoutes}));
}

}  // namespace hlc::apps
