// The high-level controller of one vehicle. Started by the lab control centre with the lab's flags,
// or by launch_scripts/vehicle.sh.
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "hlc_bridge/apps/flags.hpp"
#include "hlc_bridge/apps/message_recording.hpp"
#include "hlc_bridge/apps/process_per_vehicle.hpp"
#include "hlc_bridge/apps/program_version.hpp"
#include "hlc_bridge/apps/run_program.hpp"
#include "hlc_bridge/apps/scenario_choice.hpp"
#include "hlc_bridge/messages/exit_codes.hpp"
#include "hlc_bridge/messages/node_names.hpp"
#include "hlc_bridge/process/hlc_process.hpp"
#include "hlc_bridge/time/precedence.hpp"
#include "hlc_bridge/time/wall_time.hpp"
#include "planner/apps/scenario_flags.hpp"
#include "planner/maneuver_design/built_automaton.hpp"
#include "planner/scenario/problem_dump.hpp"
#include "planner/scenario/scenario.hpp"

namespace {

struct Flags {
  hlc::apps::NetworkFlags network;
  std::string node_id;
  std::vector<int> vehicle_ids;
  int middleware_domain{1};
  std::optional<int> controller_domain;
  std::vector<std::string> controller_peers;
  std::optional<std::filesystem::path> problem_folder;
  int thread_priority{1};
  std::optional<int> core;
  std::string dds_initial_peer;
  hlc::scenario::ScenarioChoices scenario;
  bool is_scenario_given{};
};

/// @throws std::invalid_argument naming the source of a scenario that does not exist
std::filesystem::path chosen_scenario(const std::filesystem::path& flag) {
  const char* const environment = std::getenv(hlc::apps::kScenarioVariable);
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe");
  return hlc::apps::scenario_file(flag, environment == nullptr ? "" : environment,
                                  program.parent_path());
}

void declare(CLI::App& app, Flags& flags) {
  app.add_option("--vehicle_ids", flags.vehicle_ids,
                 "vehicles to control, e.g. 1,2: each by a separate process")
      ->delimiter(',')
      ->required()
      ->check(hlc::apps::vehicle_id_range());
  hlc::apps::declare_scenario_flags(app, flags.scenario);
  app.get_option("--scenario")
      ->required(false)
      ->description(
          "file (YAML), or the name of one in the folder scenarios beside this program; "
          "default: environment variable HLC_SCENARIO, else the only line of the file "
          "default_scenario beside this program, else lab_three_cars");
  app.add_option("--node_id", flags.node_id,
                 "name in the log, with several vehicles _<id> is appended; default: "
                 "high_level_controller_<id>");
  app.add_option(
      "--dds_initial_peer", flags.dds_initial_peer,
      "accepted and ignored: the lab's scripts pass it, but no program reads it; default: none");
  app.add_option("--middleware_domain", flags.middleware_domain, "local domain")
      ->capture_default_str();
  app.add_option("--controller_domain", flags.controller_domain,
                 "domain of the controllers; default: lab domain + 50");
  hlc::apps::declare_controller_peers(app, flags.controller_peers);
  app.add_option(
         "--dump_problems", flags.problem_folder,
         "folder for the planning problems, one JSON file each (see plan_problem). They are "
         "written after a step's command; plans stay the same, but in real time "
         "a slow disk may delay the next step")
      ->type_name("DIR");
  app.add_option("--thread_priority", flags.thread_priority,
                 "real-time priority of the planning thread, where the system allows it; 0: none")
      ->capture_default_str()
      ->check(hlc::apps::whole(0, hlc::time::kMaxThreadPriority));
  app.add_option("--core", flags.core, "processor core of the planning thread; default: any")
      ->check(hlc::apps::whole(0, hlc::time::kMaxCore));
  flags.network.declare(app);
  hlc::apps::declare_help_end(
      app,
      {.examples = {"high_level_controller --vehicle_ids 1 --scenario paper_red_alone --dds_domain "
                    "40 --middleware_domain 41 --transport loopback --simulated_time true",
                    "high_level_controller --vehicle_ids 1,2 --scenario lab_three_cars --log_level "
                    "warning"},
       .exit_codes =
           "0 success, 1 success, but --dump_problems or --messages_folder is incomplete, 2 "
           "invalid input, 3 startup timeout, 4 the middleware or lab control died"});
}

hlc::process::HlcProcessOptions process_options(const Flags& flags, hlc::VehicleId id) {
  const hlc::apps::NetworkFlags& network = flags.network;
  hlc::process::HlcProcessOptions options;
  options.version = hlc::apps::program_version();
  options.node_id = flags.node_id.empty() ? hlc::controller_name(id.value) : flags.node_id;
  if (!flags.node_id.empty() && flags.vehicle_ids.size() > 1) {
    options.node_id += fmt::format("_{}", id.value);
  }
  if (!flags.dds_initial_peer.empty()) {
    spdlog::warn(fmt::format("{}: --dds_initial_peer = {} is ignored, as by the lab's own programs",
                             options.node_id, flags.dds_initial_peer));
  }
  options.transport = hlc::dds::transport_from_name(network.transport);
  options.domains = {.lab = network.dds_domain,
                     .local = flags.middleware_domain,
                     .controller = flags.controller_domain
                                       ? *flags.controller_domain
                                       : hlc::dds::default_controller_domain(network.dds_domain)};
  for (const std::string& warning : hlc::dds::check_domains(options.domains, options.transport)) {
    spdlog::warn(fmt::format("{}: {}", options.node_id, warning));
  }
  options.discovery_server = network.discovery_server();
  options.security = network.security;
  hlc::dds::check_addresses("--controller_peers", flags.controller_peers);
  options.controller_peers = flags.controller_peers;
  options.thread_priority = flags.thread_priority;
  options.core = flags.core;
  options.startup_timeout = network.startup_timeout();
  options.time = hlc::machine::run_time(network.simulated_time);
  const bool is_in_the_lab = options.transport == hlc::dds::Transport::kLab;
  options.rules = network.simulated_time
                      ? hlc::high_level_controller::rules_in_logical_time(is_in_the_lab)
                      : hlc::high_level_controller::rules_in_real_time(
                            is_in_the_lab, hlc::high_level_controller::StepDeadlines{},
                            hlc::time::nanoseconds(options.startup_timeout));
  return options;
}

std::shared_ptr<hlc::process::HlcProcess> make_process(const Flags& flags,
                                                       const hlc::scenario::Scenario& scenario,
                                                       int vehicle_id,
                                                       hlc::apps::MessageRecording& recording) {
  const hlc::VehicleId id{static_cast<std::uint8_t>(vehicle_id)};
  hlc::process::HlcProcessOptions options = process_options(flags, id);
  options.on_published =
      recording.open(flags.network.messages, flags.network.simulated_time, options.node_id);
  if (!flags.is_scenario_given) {
    spdlog::info(fmt::format("{}: scenario {}", options.node_id, flags.scenario.file.string()));
  }
  options.configuration = [file = scenario.automaton_file] {
    return hlc::maneuver_design::read_configuration_of(file);
  };
  options.reconfiguration = scenario.reconfiguration;
  if (flags.problem_folder) {
    options.after_step =
        [dump = hlc::scenario::ProblemDump(*flags.problem_folder, scenario.automaton_file,
                                           scenario.subgraph->spec())](
            const hlc::controller::Controller& controller) mutable { dump.write(controller); };
  }
  return std::make_shared<hlc::process::HlcProcess>(options,
                                                    hlc::scenario::make_controller(scenario, id));
}

}  // namespace

int main(int argc, char** argv) {
  hlc::time::StopSignals signals;
  hlc::apps::CommandLine app{
      "High-level controller: plans one vehicle's motion and agrees with the others.",
      "high_level_controller"};
  Flags flags;
  declare(app, flags);
  if (const auto code = hlc::apps::parse_lab_flags(app, flags.network, argc, argv)) return *code;
  const std::string program = "high_level_controller";
  std::optional<hlc::scenario::Scenario> scenario;
  const int code = hlc::apps::exit_code_of(program.c_str(), [&] {
    hlc::apps::check_each_once("--vehicle_ids", flags.vehicle_ids);
    flags.is_scenario_given = !flags.scenario.file.empty();
    flags.scenario.file = chosen_scenario(flags.scenario.file);
    scenario = hlc::scenario::read_scenario(flags.scenario);
    if (scenario->vehicles.back().id.value > hlc::kMaxLabVehicleId) {
      throw std::invalid_argument(fmt::format(
          "{}: vehicle {}, must be in 1 ... {} in the lab", flags.scenario.file.string(),
          scenario->vehicles.back().id.value, hlc::kMaxLabVehicleId));
    }
  });
  if (code != hlc::kExitGood) return hlc::kExitBadInput;
  const auto run = [&](int id, hlc::time::StopSignals& own_signals) {
    hlc::apps::MessageRecording recording;
    return hlc::apps::run_program(
        program, own_signals, [&] { return make_process(flags, *scenario, id, recording); },
        [](hlc::process::HlcProcess& process) { process.stop(); },
        [&](int exit_code) { return recording.close(exit_code); });
  };
  return hlc::apps::process_per_vehicle(flags.vehicle_ids, signals, run);
}
