#include "hlc_bridge/process/hlc_endpoints.hpp"

#include "hlc_bridge/dds/topics.hpp"

namespace hlc::process {
namespace {

/// Reader callbacks.
auto posts_to(Shell<high_level_controller::HlcMachine>& shell) {
  return [&shell](const auto& message) { shell.post(message); };
}
auto wakes(Shell<high_level_controller::HlcMachine>& shell) {
  return [&shell](const auto& message) { shell.post_urgent(message); };
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
                       const high_level_controller::HlcRules& rules)
    : traffic(domains.controllers, dds::topics::traffic(), posts_to(shell)),
      prediction(domains.controllers, dds::topics::prediction(), posts_to(shell)),
      outcome(domains.controllers, dds::topics::outcome(), posts_to(shell)),
      automaton_request(domains.controllers, dds::topics::automaton_request(), wakes(shell)),
      run_state(domains.controllers, dds::topics::run_state(), wakes(shell)),
      trigger(domains.local, dds::topics::system_trigger(),
              [&shell](const SystemTrigger& message) {
                if (message.next_start == kStopSymbol) return shell.post_urgent(message);
                shell.post(message);
              }),
      list(domains.local, dds::topics::vehicle_state_list(), wakes(shell)) {
  if (rules.asks_lab_control) {
    parameter.emplace(domains.lab, dds::topics::parameter(), wakes(shell));
  }
  if (!rules.stops_on_lab_domain) return;
  lab_stop.emplace(domains.lab, dds::topics::system_trigger(),
                   [&shell](const SystemTrigger& message) {
                     if (message.next_start == kStopSymbol) shell.post_urgent(message);
                   });
}

}  // namespace hlc::process
