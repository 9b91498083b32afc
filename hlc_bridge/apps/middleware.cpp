// The middleware of one vehicle's controller, or of several. Flags as in the lab.
#include "hlc_bridge/process/middleware_process.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <memory>
#include <stdexcept>
#include <vector>

#include "hlc_bridge/apps/flags.hpp"
#include "hlc_bridge/apps/message_recording.hpp"
#include "hlc_bridge/apps/program_version.hpp"
#include "hlc_bridge/apps/run_program.hpp"
#include "hlc_bridge/messages/node_names.hpp"

namespace {

struct Flags {
  hlc::apps::NetworkFlags network;
  std::string node_id;
  std::vector<int> vehicle_ids;
  bool keep_running{false};
  int middleware_domain{1};
  hlc::Nanoseconds offset_nanoseconds{hlc::kListOffset};
  bool wait_for_start{false};
};

void declare(CLI::App& app, Flags& flags) {
  flags.network.declare(app);
  app.add_option("--node_id", flags.node_id,
                 "name in the log and of the timer in logical time; default: middleware_<ids>");
  app.add_option("--vehicle_ids,--vehicle_id", flags.vehicle_ids,
                 "the controllers' vehicles, such as 1,2")
      ->delimiter(',')
      ->required()
      ->check(hlc::apps::vehicle_id_range());
  app.add_option("--middleware_domain", flags.middleware_domain, "local domain")
      ->capture_default_str();
  app.add_option("--offset_nanoseconds", flags.offset_nanoseconds,
                 "of the state lists in a period (logical time: 1)")
      ->capture_default_str();
  app.add_option("--wait_for_start", flags.wait_for_start,
                 "only false: lists come from the first period on")
      ->capture_default_str();
  app.add_flag("--keep_running", flags.keep_running,
               "wait for the next experiment after a stop (real time)");
  hlc::apps::declare_help_end(
      app, {.examples = {"middleware --vehicle_ids 1 --dds_domain 40 --middleware_domain 41 "
                         "--transport loopback",
                         "middleware --vehicle_ids 1,2 --simulated_time true --log_level warning"},
            .exit_codes = "0 success, 1 success, but --messages_folder is incomplete, 2 invalid "
                          "input, 3 startup timeout, 4 the lab control died"});
}

hlc::process::MiddlewareOptions process_options(const Flags& flags) {
  hlc::process::MiddlewareOptions options;
  options.version = hlc::apps::program_version();
  hlc::apps::check_each_once("--vehicle_ids", flags.vehicle_ids);
  for (const int id : flags.vehicle_ids) {
    options.vehicle_ids.push_back(static_cast<std::uint8_t>(id));
  }
  options.node_id =
      flags.node_id.empty() ? hlc::middleware_name(options.vehicle_ids) : flags.node_id;
  options.keep_running = flags.keep_running;
  options.transport = hlc::dds::transport_from_name(flags.network.transport);
  options.lab_domain = flags.network.dds_domain;
  options.local_domain = flags.middleware_domain;
  const hlc::dds::Domains domains{
      .lab = options.lab_domain, .local = options.local_domain, .controller = std::nullopt};
  for (const std::string& warning : hlc::dds::check_domains(domains, options.transport)) {
    spdlog::warn(fmt::format("{}: {}", options.node_id, warning));
  }
  options.discovery_server = flags.network.discovery_server();
  options.security = flags.network.security;
  const bool is_logical = flags.network.simulated_time;
  const bool beside_lab_programs = options.transport == hlc::dds::Transport::kLab;
  options.time = hlc::machine::run_time(is_logical, beside_lab_programs);
  options.rules = is_logical ? hlc::middleware::logical_middleware_rules(beside_lab_programs)
                             : hlc::middleware::real_middleware_rules(beside_lab_programs);
  options.offset = flags.offset_nanoseconds;
  options.startup_timeout = flags.network.startup_timeout();
  if (flags.wait_for_start) {
    throw std::invalid_argument("--wait_for_start = true, must be false");
  }
  if (is_logical && options.keep_running) {
    throw std::invalid_argument("--keep_running needs --simulated_time=false");
  }
  if (is_logical && options.offset != hlc::kListOffset) {
    throw std::invalid_argument(
        fmt::format("--offset_nanoseconds = {}, must be 1 in logical time", options.offset));
  }
  return options;
}

}  // namespace

int main(int argc, char** argv) {
  hlc::time::StopSignals signals;
  hlc::apps::CommandLine app{
      "Middleware: vehicle states to a controller, its commands to the vehicle.", "middleware"};
  Flags flags;
  declare(app, flags);
  if (const auto code = hlc::apps::parse_lab_flags(app, flags.network, argc, argv)) {
    return *code;
  }
  hlc::apps::MessageRecording recording;
  const auto make = [&] {
    hlc::process::MiddlewareOptions options = process_options(flags);
    options.on_published =
        recording.open(flags.network.messages, flags.network.simulated_time, options.node_id);
    return std::make_shared<hlc::process::MiddlewareProcess>(options);
  };
  return hlc::apps::run_program(
      "middleware", signals, make, [](hlc::process::MiddlewareProcess& process) { process.stop(); },
      [&](int exit_code) { return recording.close(exit_code); });
}
