#include "hlc_bridge/process/hlc_endpoints.hpp"

#include "hlc_bridge/dds/topics.hpp"

namespace hlc {
namespace {

/// Reader callbacks.
auto posts_to(Shell<HlcMachine>& shell) {
  return [&shell](const auto& message) { shell.post(message); };
}
auto wakes(Shell<HlcMachine>& shell) {
  return [&shell](const auto& message) { shell.post_urgent(message); };
}

}  // namespace

HlcWriters::HlcWriters(HlcDomains& domains, const std::function<void()>& on_presence)
    : traffic(domains.controllers, topics::traffic(), on_presence),
      prediction(domains.controllers, topics::prediction(), on_presence),
      outcome(domains.controllers, topics::outcome(), on_presence),
      command(domains.local, topics::command(), on_presence),
      report(domains.controllers, topics::report()),
      ready(domains.local, topics::ready_status()),
      drawing(domains.lab, topics::visualization()),
      stop_request(domains.lab, topics::stop_request(), on_presence),
      automaton_answer(domains.controllers, topics::automaton_answer()) {}

std::set<std::string> HlcWriters::receivers() const {
  std::set<std::string> names = traffic.matched_names();
  const auto keep = [&names](const std::set<std::string>& others) {
    std::erase_if(names, [&](const std::string& name) { return !others.contains(name); });
  };
  keep(prediction.matched_names());
  keep(outcome.matched_names());
  return names;
}

HlcReaders::HlcReaders(HlcDomains& domains, Shell<HlcMachine>& shell, bool stops_on_lab)
    : traffic(domains.controllers, topics::traffic(), posts_to(shell)),
      prediction(domains.controllers, topics::prediction(), posts_to(shell)),
      outcome(domains.controllers, topics::outcome(), posts_to(shell)),
      automaton_request(domains.controllers, topics::automaton_request(), wakes(shell)),
      run_state(domains.controllers, topics::run_state(), wakes(shell)),
      trigger(domains.local, topics::system_trigger(),
              [&shell](const SystemTrigger& message) {
                if (message.next_start == kStopSymbol) return shell.post_urgent(message);
                shell.post(message);
              }),
      list(domains.local, topics::vehicle_state_list(), wakes(shell)) {
  if (!stops_on_lab) return;
  lab_stop.emplace(domains.lab, topics::system_trigger(), [&shell](const SystemTrigger& message) {
    if (message.next_start == kStopSymbol) shell.post_urgent(message);
  });
}

}  // namespace hlc
