// The high-level controller of one vehicle. Started by the lab control centre with the lab's flags,
// or by launch_scripts/vehicle.sh.
#include <spdlog/spdlog.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hlc_bridge/apps/flags.hpp"
#include "hlc_bridge/apps/run_program.hpp"
#include "hlc_bridge/core/exit_codes.hpp"
#include "hlc_bridge/core/node_names.hpp"
#include "hlc_bridge/hlc/hlc_process.hpp"
#include "planner/scenario/problem_dump.hpp"
#include "planner/scenario/scenario.hpp"

namespace {

struct Flags {
  hlc::NetworkFlags network;
  std::string node_id;
  std::vector<int> vehicle_ids;
  int middleware_domain{1};
  std::optional<int> controller_domain;
  std::optional<std::filesystem::path> problem_folder;
  hlc::ScenarioChoices scenario;
};

void declare(CLI::App& app, Flags& flags) {
  app.add_option("--vehicle_ids", flags.vehicle_ids, "vehicle to control (one id)")
      ->delimiter(',')
      ->required()
      ->expected(1)
      ->check(hlc::vehicle_id_range());
  hlc::declare_scenario_flags(app, flags.scenario);
  app.add_option("--node_id", flags.node_id,
                 "name in the log; default: high_level_controller_<id>");
  app.add_option("--middleware_domain", flags.middleware_domain, "local domain")
      ->capture_default_str();
  app.add_option("--controller_domain", flags.controller_domain,
                 "domain of the controllers; default: lab domain + 50");
  app.add_option(
      "--dump-problems,--dump_problems", flags.problem_folder,
      "folder for the planning problems, one JSON file each (see plan_problem). They are "
      "written after a step's command; what is planned stays the same, but in real time "
      "a slow disk may make the next step late");
  flags.network.declare(app);
  app.footer(
      "Exit codes: 0 good, 2 bad input, 3 somebody did not appear, 4 the middleware or lab control "
      "died.");
}

hlc::HlcProcessOptions process_options(const Flags& flags, hlc::VehicleId id) {
  const hlc::NetworkFlags& network = flags.network;
  hlc::HlcProcessOptions options;
  options.node_id = flags.node_id.empty() ? hlc::controller_name(id.value) : flags.node_id;
  options.transport = hlc::transport_from_name(network.transport);
  options.domains = {.lab = network.dds_domain,
                     .local = flags.middleware_domain,
                     .controller = flags.controller_domain
                                       ? *flags.controller_domain
                                       : hlc::default_controller_domain(network.dds_domain)};
  for (const std::string& warning : hlc::check_domains(options.domains, options.transport)) {
    spdlog::warn("{}: {}", options.node_id, warning);
  }
  options.discovery_server = network.discovery_server();
  options.logical_time = network.simulated_time;
  options.startup_timeout = network.startup_timeout();
  return options;
}

std::shared_ptr<hlc::HlcProcess> make_process(const Flags& flags) {
  const hlc::VehicleId id{static_cast<std::uint8_t>(flags.vehicle_ids.front())};
  hlc::HlcProcessOptions options = process_options(flags, id);
  const hlc::Scenario scenario = hlc::read_scenario(flags.scenario);
  if (flags.problem_folder) {
    options.after_step = [dump = hlc::ProblemDump(*flags.problem_folder, scenario.automaton_file)](
                             const hlc::Controller& controller) { dump.write(controller); };
  }
  return std::make_shared<hlc::HlcProcess>(options, hlc::make_controller(scenario, id));
}

}  // namespace

int main(int argc, char** argv) {
  hlc::StopSignals signals;
  CLI::App app{"High-level controller: plans one vehicle's motion and agrees with the others.",
               "high_level_controller"};
  Flags flags;
  declare(app, flags);
  if (const auto code = hlc::parse_flags(app, argc, argv)) return *code;
  return hlc::run_program(
      "high_level_controller", signals, [&] { return make_process(flags); },
      [](hlc::HlcProcess& process) { process.stop(); });
}
