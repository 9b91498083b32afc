// Shows a run under way in browsers.
#include <fmt/format.h>
#include <spdlog/sinks/stdout_color_sinks.h>

#include <algorithm>
#include <atomic>
#include <iostream>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "hlc_bridge/apps/flags.hpp"
#include "hlc_bridge/apps/run_program.hpp"
#include "hlc_bridge/live/lab_listener.hpp"
#include "hlc_bridge/live/server.hpp"
#include "hlc_bridge/machine/pacing.hpp"
#include "hlc_bridge/record/log_files.hpp"
#include "hlc_bridge/result/run_description.hpp"
#include "hlc_bridge/time/real_time.hpp"
#include "hlc_bridge/view/live_messages.hpp"
#include "hlc_bridge/view/live_scene.hpp"
#include "planner/apps/scenario_flags.hpp"
#include "planner/common/program_version.hpp"
#include "planner/scenario/scenario.hpp"

namespace {

/// The page is a step of 200 ms behind: more portions would not show more.
constexpr std::chrono::milliseconds kTick{100};
constexpr int kLastTicks = 5;  ///< after the run's end, for the last messages on their way
constexpr std::size_t kMostHistoryBytes = 120'000'000;

struct Flags {
  hlc::apps::NetworkFlags network;
  hlc::scenario::ScenarioChoices scenario;
  hlc::live::ServerOptions server;
  std::vector<int> vehicle_ids;
  std::optional<int> controller_domain;
  std::vector<std::string> controller_peers;
  std::filesystem::path logs;
};

void declare(CLI::App& app, Flags& flags) {
  app.add_option(
         "--port", flags.server.port,
         fmt::format("of the page, 0: any free one; default: the first free one of {} ... {}",
                     hlc::live::kFirstPort, hlc::live::kFirstPort + hlc::live::kNumPorts - 1))
      ->check(hlc::apps::whole(0, 65535));
  app.add_option("--listen", flags.server.address,
                 "address of this machine that browsers can reach; others than 127.0.0.1 show the "
                 "run to whoever reaches them")
      ->capture_default_str();
  app.add_option("--vehicle_ids", flags.vehicle_ids,
                 "vehicles that take part, e.g. 1,2,3; default: the scenario's")
      ->delimiter(',')
      ->check(hlc::apps::vehicle_id_range());
  app.add_option("--logs", flags.logs,
                 fmt::format("folder in which the processes write their logs (*.log): the page "
                             "shows their first {} lines; default: none",
                             hlc::record::kMostLoggedLines))
      ->check(CLI::ExistingDirectory);
  hlc::apps::declare_scenario_flags(app, flags.scenario);
  app.add_option("--simulated_time", flags.network.simulated_time,
                 "of the run; true: logical time, false: real time")
      ->capture_default_str();
  flags.network.declare_network(app);
  app.add_option("--controller_domain", flags.controller_domain,
                 "domain of the controllers; default: lab domain + 50");
  hlc::apps::declare_controller_peers(app, flags.controller_peers);
  hlc::apps::declare_help_end(
      app, {.examples = {"view --scenario paper_three_cars --dds_domain 40 --transport loopback",
                         "view --scenario lab_three_cars --port 8400 --listen 192.168.1.10 --logs "
                         "runs/my_run/logs"},
            .exit_codes = "0 success, 2 invalid input or no port, 4 failed",
            .notes = "Foxglove connects to the same address by its websocket protocol. Publishes "
                     "nothing: the run is the same with it. Ends with the run."});
}

/// Vehicles that the scenario does not name drive on a route that they choose themselves.
void add_others(const std::vector<int>& ids, hlc::result::RunDescription& description) {
  for (const int id : ids) {
    const auto is_it = [id](const auto& vehicle) { return vehicle.id.value == id; };
    if (std::ranges::any_of(description.vehicles, is_it)) continue;
    description.vehicles.push_back({.id = hlc::VehicleId{static_cast<std::uint8_t>(id)},
                                    .name = {},
                                    .route = {},
                                    .footprint = description.vehicles.front().footprint});
  }
}

hlc::view::FinishedRun begin_of_run(const Flags& flags) {
  hlc::apps::check_each_once("--vehicle_ids", flags.vehicle_ids);
  const hlc::scenario::Scenario scenario = hlc::scenario::read_scenario(flags.scenario);
  hlc::view::FinishedRun run;
  run.description = hlc::result::describe(scenario, std::nullopt);
  add_others(flags.vehicle_ids, run.description);
  if (scenario.map_file) run.map = hlc::road::read_lanelet_map(*scenario.map_file);
  run.facts.simulated_time = flags.network.simulated_time;
  run.time = flags.network.simulated_time ? "logical time" : "real time";
  run.revision = hlc::program_revision();
  run.facts.period = static_cast<hlc::Nanoseconds>(std::llround(run.description.step_s * 1e9));
  for (const int id : flags.vehicle_ids) {
    run.facts.vehicle_ids.push_back(static_cast<std::uint8_t>(id));
  }
  if (!flags.vehicle_ids.empty()) return run;
  for (const hlc::result::VehicleDescription& vehicle : run.description.vehicles) {
    run.facts.vehicle_ids.push_back(vehicle.id.value);
  }
  run.show_guests();
  return run;
}

hlc::live::ListenerOptions listener_options(const Flags& flags, const hlc::view::FinishedRun& run) {
  const hlc::apps::NetworkFlags& network = flags.network;
  hlc::live::ListenerOptions options;
  options.transport = hlc::dds::transport_from_name(network.transport);
  options.lab_domain = network.dds_domain;
  options.controller_domain = flags.controller_domain
                                  ? *flags.controller_domain
                                  : hlc::dds::default_controller_domain(network.dds_domain);
  const hlc::dds::Domains domains{
      .lab = options.lab_domain, .local = {}, .controller = options.controller_domain};
  for (const std::string& warning : hlc::dds::check_domains(domains, options.transport)) {
    spdlog::warn(warning);
  }
  options.lease = hlc::machine::run_time(network.simulated_time).lease;
  options.discovery_server = network.discovery_server();
  options.security = network.security;
  hlc::dds::check_addresses("--controller_peers", flags.controller_peers);
  options.controller_peers = flags.controller_peers;
  for (const hlc::result::VehicleDescription& guest : run.description.guests) {
    options.guest_ids.push_back(guest.id.value);
  }
  std::ranges::copy_if(
      run.facts.vehicle_ids, std::back_inserter(options.vehicle_ids),
      [&](std::uint8_t id) { return std::ranges::count(options.guest_ids, id) == 0; });
  return options;
}

class View {
 public:
  View(const Flags& flags, hlc::view::FinishedRun run)
      : history_(std::to_string(hlc::time::real_time_now())),
        newest_(std::to_string(hlc::time::real_time_now())),
        server_(flags.server, history_, newest_),
        listener_(listener_options(flags, run)),
        logs_(flags.logs),
        scene_(run),
        messages_(std::move(run)) {
    if (server_.is_open_to_others()) {
      spdlog::warn(fmt::format("--listen = {}: the run is shown to whoever reaches this address",
                               flags.server.address));
    }
    std::cout << "view: " << server_.url() << std::endl;
  }

  int run() {
    server_.run(kTick, [this] { tick(); });
    return hlc::kExitGood;
  }
  void stop() { stop_ = true; }

 private:
  void tick() {
    if (history_.has_ended()) return;
    const hlc::live::LabListener::Received received = listener_.take();
    for (const hlc::ReportRecord& record : received.reports) take(record);
    for (const hlc::VehicleState& state : received.states) take(state);
    messages_.take(logs_.new_lines(messages_.facts()));
    for (hlc::view::SceneMessage& message : scene_.updates()) newest_.take(std::move(message));
    ticks_after_run_ = listener_.run_is_over() ? ticks_after_run_ + 1 : 0;
    if (stop_ || ticks_after_run_ > kLastTicks) return end("The run has ended.");
    if (history_.num_bytes() > kMostHistoryBytes) {
      spdlog::warn(
          fmt::format("the run is longer than the {} MB kept for browsers: they get no more of it",
                      kMostHistoryBytes / 1'000'000));
      return end("The run goes on, but this view is full.");
    }
    if (const std::string portion = messages_.portion(); !portion.empty()) {
      history_.append(portion);
    }
  }
  template <class Message>
  void take(const Message& message) {
    messages_.take(message);
    scene_.take(message);
  }
  void end(const std::string& reason) {
    history_.append(messages_.last_portion(reason));
    history_.end();
  }

  hlc::live::History history_;
  hlc::live::NewestMessages newest_;
  hlc::live::Server server_;
  hlc::live::LabListener listener_;
  hlc::record::GrowingLogs logs_;
  hlc::view::LiveScene scene_;
  hlc::view::LiveMessages messages_;
  int ticks_after_run_{};
  std::atomic<bool> stop_{};
};

}  // namespace

int main(int argc, char** argv) {
  hlc::time::StopSignals signals;
  spdlog::set_default_logger(spdlog::stderr_color_mt("view"));
  hlc::apps::CommandLine app{"Shows a run under way in browsers: prints the page's address.",
                             "view"};
  Flags flags;
  declare(app, flags);
  if (const auto code = hlc::apps::parse_flags(app, argc, argv)) return *code;
  return hlc::apps::run_program(
      "view", signals, [&] { return std::make_shared<View>(flags, begin_of_run(flags)); },
      [](View& view) { view.stop(); });
}
