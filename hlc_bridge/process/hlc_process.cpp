#include "hlc_bridge/process/hlc_process.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <iterator>
#include <set>
#include <thread>
#include <utility>

#include "hlc_bridge/dds/topics.hpp"
#include "hlc_bridge/machine/pacing.hpp"
#include "hlc_bridge/messages/node_names.hpp"
#include "hlc_bridge/process/log.hpp"
#include "hlc_bridge/time/precedence.hpp"
#include "hlc_bridge/time/resident_memory.hpp"
#include "hlc_bridge/time/thread_clock.hpp"
#include "hlc_bridge/view/lab_map.hpp"

namespace hlc {
namespace {

/// For a step's messages, problems and plans.
constexpr std::size_t kHeapReserve = std::size_t{4} << 20;

Nanoseconds startup_timeout(const HlcProcessOptions& options) {
  return static_cast<Nanoseconds>(std::chrono::nanoseconds{options.startup_timeout}.count());
}

HlcSettings settings_of(const HlcProcessOptions& options) {
  const bool keeps_commands = options.transport == Transport::kLoopback;
  return {.rules = options.logical_time ? rules_in_logical_time(keeps_commands)
                                        : rules_in_real_time(keeps_commands, options.deadlines,
                                                             startup_timeout(options)),
          .startup_timeout = startup_timeout(options),
          .reconfiguration = options.reconfiguration,
          .cpu_time = thread_time_now};
}

std::unique_ptr<Pacing> pacing_of(const HlcProcessOptions& options) {
  if (!options.logical_time) return std::make_unique<RealPacing>();
  return std::make_unique<LogicalPacing>(LogicalPacing::patience_for(startup_timeout(options)),
                                         wall_time_now());
}

}  // namespace

HlcProcess::HlcProcess(HlcProcessOptions options, std::unique_ptr<Controller> controller)
    : options_(std::move(options)),
      shell_(options_.node_id, HlcMachine(settings_of(options_), std::move(controller)),
             pacing_of(options_)),
      vehicle_(shell_.machine().controller().options().vehicle),
      lab_(on_domain(options_.domains.lab, DomainRole::kLab), on_presence()),
      local_(on_domain(options_.domains.local, DomainRole::kLocal), on_presence()),
      controllers_(on_domain(options_.domains.controller, DomainRole::kController), on_presence()),
      traffic_writer_(controllers_, topics::traffic(), on_presence()),
      prediction_writer_(controllers_, topics::prediction(), on_presence()),
      outcome_writer_(controllers_, topics::outcome(), on_presence()),
      command_writer_(local_, topics::command(), on_presence()),
      report_writer_(controllers_, topics::report()),
      ready_writer_(local_, topics::ready_status()),
      drawing_writer_(lab_, topics::visualization()),
      stop_request_writer_(lab_, topics::stop_request(), on_presence()),
      automaton_answer_writer_(controllers_, topics::automaton_answer()),
      lab_log_(lab_, options_.node_id),
      preparation_(shell_.machine().request_base(),
                   {shell_.machine().controller().subgraph().shared_automaton(),
                    options_.configuration, shell_.machine().controller().options().lab},
                   [this](PreparedRequest prepared) { shell_.post_urgent(std::move(prepared)); }),
      traffic_reader_(controllers_, topics::traffic(),
                      [this](const Traffic& message) { shell_.post(message); }),
      prediction_reader_(controllers_, topics::prediction(),
                         [this](const Prediction& message) { shell_.post(message); }),
      outcome_reader_(controllers_, topics::outcome(),
                      [this](const Outcome& message) { shell_.post(message); }),
      automaton_request_reader_(
          controllers_, topics::automaton_request(),
          [this](const AutomatonRequest& request) { shell_.post_urgent(request); }),
      run_state_reader_(controllers_, topics::run_state(),
                        [this](const RunState& state) { shell_.post_urgent(state); }),
      trigger_reader_(local_, topics::system_trigger(),
                      [this](const SystemTrigger& trigger) { take(trigger); }),
      list_reader_(local_, topics::vehicle_state_list(),
                   [this](const VehicleStateList& list) { shell_.post_urgent(list); }) {
  if (options_.logical_time) return;  // 50 triggers a second and no car that a stop could save
  lab_stop_reader_.emplace(lab_, topics::system_trigger(), [this](const SystemTrigger& trigger) {
    if (trigger.next_start == kStopSymbol) take(trigger);
  });
}

ParticipantOptions HlcProcess::on_domain(std::optional<int> domain, DomainRole role) {
  return {.name = controller_name(vehicle_.value),
          .domain_id = domain.value(),
          .role = role,
          .transport = options_.transport,
          .logical_time = options_.logical_time,
          .discovery_server = role == DomainRole::kLab ? options_.discovery_server : std::nullopt,
          .peers = role == DomainRole::kController ? options_.controller_peers
                                                   : std::vector<std::string>{},
          .version = options_.version,
          .on_loss = [this](const std::string& line) { shell_.post(LostMessage{line}); }};
}

/// A middleware may forward the trigger of every tick: only the stop is worth waking up for.
void HlcProcess::take(const SystemTrigger& trigger) {
  if (trigger.next_start == kStopSymbol) return shell_.post_urgent(trigger);
  shell_.post(trigger);
}

void HlcProcess::prepare_thread() const {
  make_code_resident();
  reserve_heap(kHeapReserve);
  if (options_.thread_priority > 0 && !take_precedence(options_.thread_priority)) {
    spdlog::info("{}: no real-time priority (ulimit -r): planning may be preempted",
                 options_.node_id);
  }
  if (options_.core && !stay_on_core(*options_.core)) {
    spdlog::warn("{}: --core = {}: no such core for this process, must be in 0 ... {}",
                 options_.node_id, *options_.core, std::thread::hardware_concurrency() - 1);
  }
}

int HlcProcess::run() {
  prepare_thread();  // not earlier: only this thread plans
  return shell_.run(*this);
}

HlcPeers HlcProcess::presence() const {
  const auto participants = [](const Participant& domain) {
    return machine::Participants{.alive = domain.alive(), .lost = domain.lost()};
  };
  std::set<std::string> receivers = traffic_writer_.matched_names();
  const auto keep = [&receivers](const std::set<std::string>& others) {
    std::erase_if(receivers, [&](const std::string& name) { return !others.contains(name); });
  };
  keep(prediction_writer_.matched_names());
  keep(outcome_writer_.matched_names());
  return {.lab = participants(lab_),
          .local = participants(local_),
          .controllers = participants(controllers_),
          .receivers = std::move(receivers),
          .command_readers = command_writer_.matched(),
          .stop_request_readers = stop_request_writer_.matched()};
}

void HlcProcess::perform(const DrawStep& action) {
  if (drawing_writer_.matched() == 0) return;
  for (const Visualization& drawing :
       lab_map(shell_.machine().controller(), action.report, action.time_to_live)) {
    drawing_writer_.write(drawing);
  }
}

void HlcProcess::perform(const AfterStep& /*action*/) {
  if (!options_.after_step) return;
  try {
    options_.after_step(shell_.machine().controller());
  } catch (const std::exception& error) {
    options_.after_step = nullptr;
    shell_.post_urgent(AfterStepFailure{error.what()});
  }
}

}  // namespace hlc
