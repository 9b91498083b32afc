// The lab control of a run: starts it, releases the ticks of logical time, monitors, stops and
// records it.
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <vector>

#include "hlc_bridge/apps/flags.hpp"
#include "hlc_bridge/apps/message_recording.hpp"
#include "hlc_bridge/apps/program_version.hpp"
#include "hlc_bridge/apps/run_program.hpp"
#include "hlc_bridge/lab_control/logical_run.hpp"
#include "hlc_bridge/machine/pacing.hpp"
#include "hlc_bridge/messages/node_names.hpp"
#include "hlc_bridge/process/lab_control_process.hpp"

namespace {

struct Flags {
  hlc::apps::NetworkFlags network;
  int controller_domain{-1};
  std::vector<std::string> controller_peers;
  std::vector<int> vehicle_ids;
  std::vector<int> guest_ids;
  std::uint64_t steps{150};
  std::uint64_t period_ms{200};
  std::string out;
  std::string on_death{"stop"};
};

void declare(CLI::App& app, Flags& flags) {
  flags.network.startup_timeout_s = 20;
  flags.network.declare(app);
  app.add_option("--controller_domain", flags.controller_domain,
                 "domain of the controllers; default: lab domain + 50");
  hlc::apps::declare_controller_peers(app, flags.controller_peers);
  app.add_option("--vehicle_ids", flags.vehicle_ids, "all vehicles of the run: 1,2,3")
      ->delimiter(',')
      ->required()
      ->check(hlc::apps::vehicle_id_range());
  app.add_option("--guest_ids", flags.guest_ids,
                 "vehicles that take no part in the coordination, without controllers: 30; "
                 "default: none")
      ->delimiter(',')
      ->check(hlc::apps::vehicle_id_range());
  app.add_option("--steps", flags.steps, "control steps of the run")
      ->capture_default_str()
      ->check(hlc::apps::whole(1, 10000));
  app.add_option("--period_ms", flags.period_ms, "duration of a control step")
      ->capture_default_str()
      ->check(hlc::apps::whole(20, 10000));
  app.add_option("--out", flags.out, "run folder for reports.csv and run.json; default: none")
      ->type_name("DIR");
  app.add_option(
         "--on_death", flags.on_death,
         "stop: minimal-risk stop of all cars, then end of the run; continue (real time): go on; a "
         "process that died may be restarted")
      ->capture_default_str()
      ->check(CLI::IsMember({"stop", "continue"}));
  hlc::apps::declare_help_end(
      app,
      {.examples = {"lab_control --vehicle_ids 1 --dds_domain 40 --transport loopback "
                    "--simulated_time true --out runs/by_hand",
                    "lab_control --vehicle_ids 1,2,3 --steps 300 --on_death continue"},
       .exit_codes =
           "0 success, 1 success, but --out or --messages_folder is incomplete, 2 invalid input, 3 "
           "startup timeout, 4 a process died during the run (--on_death continue: and was not "
           "back at its end), 6 driven, but a vehicle was stuck at the end, 130 interrupted"});
}

hlc::process::LabControlOptions process_options(const Flags& flags) {
  hlc::process::LabControlOptions options;
  options.version = hlc::apps::program_version();
  hlc::apps::check_each_once("--vehicle_ids", flags.vehicle_ids);
  std::vector<int> ids = flags.vehicle_ids;
  std::ranges::sort(ids);
  for (const int id : ids) {
    options.run.vehicle_ids.push_back(static_cast<std::uint8_t>(id));
  }
  for (const int id : flags.guest_ids) {
    options.run.guest_ids.push_back(static_cast<std::uint8_t>(id));
    ids.push_back(id);
  }
  hlc::apps::check_each_once("--guest_ids", ids);
  options.run.period = flags.period_ms * hlc::kNanosecondsPerMillisecond;
  options.run.steps = flags.steps;
  options.run.startup_timeout =
      static_cast<hlc::Nanoseconds>(flags.network.startup_timeout_s) * hlc::kNanosecondsPerSecond;
  if (flags.on_death == "continue") {
    if (flags.network.simulated_time) {
      throw std::invalid_argument(
          "--on_death = continue with --simulated_time = true, must be stop: logical time waits "
          "for all processes");
    }
    options.run.on_death = hlc::lab_control::OnDeath::kContinue;
  }
  options.transport = hlc::dds::transport_from_name(flags.network.transport);
  options.lab_domain = flags.network.dds_domain;
  hlc::dds::check_domain_id("--dds_domain", options.lab_domain);
  options.controller_domain = flags.controller_domain >= 0
                                  ? flags.controller_domain
                                  : hlc::dds::default_controller_domain(options.lab_domain);
  const hlc::dds::Domains domains{
      .lab = options.lab_domain, .local = std::nullopt, .controller = options.controller_domain};
  for (const std::string& warning : hlc::dds::check_domains(domains, options.transport)) {
    spdlog::warn(warning);
  }
  options.discovery_server = flags.network.discovery_server();
  options.security = flags.network.security;
  hlc::dds::check_addresses("--controller_peers", flags.controller_peers);
  options.controller_peers = flags.controller_peers;
  if (flags.network.simulated_time) {
    options.time = hlc::machine::kLogicalTime;
    options.make_run = hlc::lab_control::make_lab_run<hlc::lab_control::LogicalRun>;
  }
  options.out = flags.out;
  options.is_terminal = isatty(STDERR_FILENO) != 0;
  return options;
}

}  // namespace

int main(int argc, char** argv) {
  hlc::time::StopSignals signals;
  spdlog::set_default_logger(spdlog::stderr_color_mt(hlc::kLabControlName));
  hlc::apps::CommandLine app{"Lab control: starts, clocks, monitors, stops and records a run.",
                             hlc::kLabControlName};
  Flags flags;
  declare(app, flags);
  if (const auto code = hlc::apps::parse_lab_flags(app, flags.network, argc, argv)) {
    return *code;
  }
  hlc::apps::MessageRecording recording;
  const auto make = [&] {
    hlc::process::LabControlOptions options = process_options(flags);
    options.on_published = recording.open(flags.network.messages, flags.network.simulated_time,
                                          hlc::kLabControlName, options.run.period);
    return std::make_shared<hlc::process::LabControlProcess>(options);
  };
  return hlc::apps::run_program(
      hlc::kLabControlName, signals, make,
      [](hlc::process::LabControlProcess& process) { process.interrupt(); },
      [&](int exit_code) { return recording.close(exit_code); });
}
