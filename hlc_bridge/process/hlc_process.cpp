#include "hlc_bridge/process/hlc_process.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <set>
#include <thread>
#include <utility>

#include "hlc_bridge/machine/pacing.hpp"
#include "hlc_bridge/messages/node_names.hpp"
#include "hlc_bridge/process/log.hpp"
#include "hlc_bridge/time/precedence.hpp"
#include "hlc_bridge/time/resident_memory.hpp"
#include "hlc_bridge/time/thread_clock.hpp"
#include "hlc_bridge/view/lab_map.hpp"

namespace hlc::process {
namespace {

/// For a step's messages, problems and plans.
constexpr std::size_t kHeapReserve = std::size_t{4} << 20;

high_level_controller::HlcSettings settings_of(const HlcProcessOptions& options) {
  return {.rules = options.rules,
          .startup_timeout = time::nanoseconds(options.startup_timeout),
          .reconfiguration = options.reconfiguration,
          .cpu_time = time::thread_time_now};
}

std::function<void()> on_presence(Shell<high_level_controller::HlcMachine>& shell) {
  return [&shell] { shell.presence_changed(); };
}

}  // namespace

HlcProcess::HlcProcess(HlcProcessOptions options,
                       std::unique_ptr<controller::Controller> controller)
    : options_(std::move(options)),
      shell_(options_.node_id,
             high_level_controller::HlcMachine(settings_of(options_), std::move(controller)),
             options_.time.make_pacing(time::nanoseconds(options_.startup_timeout),
                                       time::wall_time_now())),
      vehicle_(shell_.machine().controller().options().vehicle),
      domains_{.lab = dds::Participant(on_domain(options_.domains.lab, dds::DomainRole::kLab),
                                       on_presence(shell_)),
               .local = dds::Participant(on_domain(options_.domains.local, dds::DomainRole::kLocal),
                                         on_presence(shell_)),
               .controllers = dds::Participant(
                   on_domain(options_.domains.controller, dds::DomainRole::kController),
                   on_presence(shell_))},
      writers_(domains_, on_presence(shell_), options_.rules.asks_lab_control),
      lab_log_(domains_.lab, options_.node_id),
      preparation_(shell_.machine().request_base(),
                   {shell_.machine().controller().subgraph().shared_automaton(),
                    options_.configuration, shell_.machine().controller().options().lab},
                   [this](high_level_controller::PreparedRequest prepared) {
                     shell_.post_urgent(std::move(prepared));
                   }),
      readers_(domains_, shell_, options_.rules, vehicle_) {}

dds::ParticipantOptions HlcProcess::on_domain(std::optional<int> domain, dds::DomainRole role) {
  return {
      .name = controller_name(vehicle_.value),
      .domain_id = domain.value(),
      .role = role,
      .transport = options_.transport,
      .lease = options_.time.lease,
      .discovery_server = role == dds::DomainRole::kLab ? options_.discovery_server : std::nullopt,
      .peers = role == dds::DomainRole::kController ? options_.controller_peers
                                                    : std::vector<std::string>{},
      .version = options_.version,
      .security = options_.security,
      .on_loss =
          [this](const std::string& line) {
            shell_.post(high_level_controller::LostMessage{line});
          },
      .admits = [this](const auto& publisher,
                       std::size_t bytes) { return shell_.admits(publisher, bytes); },
      .on_published = options_.on_published};
}

void HlcProcess::prepare_thread() const {
  time::make_code_resident();
  time::reserve_heap(kHeapReserve);
  if (options_.thread_priority > 0 && !time::take_precedence(options_.thread_priority)) {
    spdlog::info(fmt::format("{}: no real-time priority (ulimit -r): planning may be preempted",
                             options_.node_id));
  }
  if (options_.core && !time::stay_on_core(*options_.core)) {
    spdlog::warn(fmt::format("{}: --core = {}: no such core for this process, must be in 0 ... {}",
                             options_.node_id, *options_.core,
                             std::thread::hardware_concurrency() - 1));
  }
}

int HlcProcess::run() {
  prepare_thread();  // not earlier: only this thread plans
  return shell_.run(*this);
}

high_level_controller::HlcPeers HlcProcess::presence() const {
  const auto participants = [](const dds::Participant& domain) {
    return machine::Participants{.alive = domain.alive(), .lost = domain.lost()};
  };
  return {.lab = participants(domains_.lab),
          .local = participants(domains_.local),
          .controllers = participants(domains_.controllers),
          .receivers = writers_.receivers(),
          .command_readers = writers_.command.matched(),
          .stop_request_readers = writers_.stop_request.matched()};
}

void HlcProcess::perform(const high_level_controller::DrawStep& action) {
  if (writers_.drawing.matched() == 0) return;
  for (const Visualization& drawing :
       view::lab_map(shell_.machine().controller(), action.report, action.time_to_live)) {
    writers_.drawing.write(drawing);
  }
}

void HlcProcess::perform(const high_level_controller::AfterStep& /*action*/) {
  if (!options_.after_step) return;
  try {
    options_.after_step(shell_.machine().controller());
  } catch (const std::exception& error) {
    options_.after_step = nullptr;
    shell_.post_urgent(high_level_controller::AfterStepFailure{error.what()});
  }
}

}  // namespace hlc::process
