#include "hlc_bridge/process/hlc_endpoints.hpp"

#include <string>
#include <utility>

#include "hlc_bridge/dds/topics.hpp"
#include "hlc_bridge/messages/node_names.hpp"
#include "hlc_bridge/messages/validate.hpp"
#include "hlc_bridge/time/real_time.hpp"

namespace hlc::process {
namespace {

/// Reader callbacks.
auto posts_to(Shell<high_level_controller::HlcMachine>& shell) {
  return [&shell](const auto& message) { shell.post(message); };
}
auto wakes(Shell<high_level_controller::HlcMachine>& shell) {
  return [&shell](const auto& message) { shell.post_urgent(message); };
}

/// A machine knows the clock of the run only, which in logical time is another.
auto wakes_if_plausible(Shell<high_level_controller::HlcMachine>& shell) {
  return [&shell, is_logged = false](const AutomatonRequest& request) mutable {
    if (is_plausible_request_id(request.id, time::real_time_now())) {
      return shell.post_urgent(request);
    }
    if (!std::exchange(is_logged, true)) {
      shell.post(high_level_controller::LostMessage{
          "request for a subgraph dropped: id must be a time that is not in the future, got " +
          std::to_string(request.id) + " (logged once)"});
    }
  };
}

template <class Message>
dds::SenderOf<Message> of_lab_control(const HlcDomains& domains) {
  return dds::only_on_loopback<Message>(domains.lab.options().transport, kLabControlName);
}

}  // namespace

HlcWriters::HlcWriters(HlcDomains& domains, const std::function<void()>& on_presence,
                       bool asks_lab_control)
    : traffic(domains.controllers, dds::topics::traffic(), on_presence),
      prediction(domains.controllers, dds::topics::prediction(), on_presence),
      outcome(domains.controllers, dds::topics::outcome(), on_presence),
      command(domains.local, dds::topics::command(), on_presence),
      report(domains.controllers, dds::topics::report()),
      ready(domains.local, dds::topics::ready_status()),
      drawing(domains.lab, dds::topics::visualization()),
      stop_request(domains.lab, dds::topics::stop_request(), on_presence),
      automaton_answer(domains.controllers, dds::topics::automaton_answer()) {
  if (asks_lab_control) parameter_request.emplace(domains.lab, dds::topics::parameter_request());
}

std::set<std::string> HlcWriters::receivers() const {
  std::set<std::string> names = traffic.matched_names();
  const auto keep = [&names](const std::set<std::string>& others) {
    std::erase_if(names, [&](const std::string& name) { return !others.contains(name); });
  };
  keep(prediction.matched_names());
  keep(outcome.matched_names());
  return names;
}

HlcReaders::HlcReaders(HlcDomains& domains, Shell<high_level_controller::HlcMachine>& shell,
                       const high_level_controller::HlcRules& rules, VehicleId vehicle)
    : traffic(domains.controllers, dds::topics::traffic(), posts_to(shell), {},
              dds::kItsController),
      prediction(domains.controllers, dds::topics::prediction(), posts_to(shell), {},
                 dds::kItsController),
      outcome(domains.controllers, dds::topics::outcome(), posts_to(shell), {},
              dds::kItsController),
      automaton_request(domains.controllers, dds::topics::automaton_request(),
                        wakes_if_plausible(shell)),
      run_state(domains.controllers, dds::topics::run_state(), wakes(shell), {},
                dds::only(kLabControlName)),
      trigger(
          domains.local, dds::topics::system_trigger(),
          [&shell](const SystemTrigger& message) {
            if (message.next_start == kStopSymbol) return shell.post_urgent(message);
            shell.post(message);
          },
          {}, dds::only(middleware_name(vehicle.value))),
      list(domains.local, dds::topics::vehicle_state_list(), wakes(shell), {},
           dds::only(middleware_name(vehicle.value))) {
  if (rules.asks_lab_control) {
    parameter.emplace(domains.lab, dds::topics::parameter(), wakes(shell), nullptr,
                      of_lab_control<Parameter>(domains));
  }
  if (!rules.stops_on_lab_domain) return;
  lab_stop.emplace(
      domains.lab, dds::topics::system_trigger(),
      [&shell](const SystemTrigger& message) {
        if (message.next_start == kStopSymbol) shell.post_urgent(message);
      },
      nullptr, of_lab_control<SystemTrigger>(domains));
}

}  // namespace hlc::process
