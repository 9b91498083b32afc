// A process that is there: peer <name> <domain> [<minutes>]. Returns every outcome that it
// receives. Ends cleanly on SIGTERM, with 1 after the minutes, 5 if not given: nothing else ends it
// if its test was killed.

#include <cstdlib>
#include <utility>
#include <vector>

#include "hlc_bridge/dds/participant.hpp"
#include "hlc_bridge/dds/reader.hpp"
#include "hlc_bridge/dds/writer.hpp"
#include "hlc_bridge/time/signal.hpp"
#include "hlc_bridge/time/stop_signals.hpp"

int main(int argc, char** argv) {
  if (argc != 3 && argc != 4) {
    return 2;
  }
  hlc::time::StopSignals stop_signals;
  hlc::dds::ParticipantOptions options;
  options.name = argv[1];
  options.domain_id = std::atoi(argv[2]);
  options.role = hlc::dds::DomainRole::kController;
  hlc::dds::Participant participant{options};
  hlc::dds::Writer<hlc::coordination::Outcome> writer{participant, hlc::dds::topics::outcome()};

  hlc::time::Signal signal;
  bool stopped = false;
  std::vector<hlc::coordination::Outcome> received;
  const hlc::dds::Reader<hlc::coordination::Outcome> reader{
      participant, hlc::dds::topics::outcome(),
      [&](const auto& outcome) { signal.post([&] { received.push_back(outcome); }); }};
  const hlc::dds::Reader<hlc::coordination::Traffic> traffic{
      participant, hlc::dds::topics::traffic(), [](const auto& /*message*/) {}};
  stop_signals.on_stop([&](int) { signal.post([&] { stopped = true; }); });
  const auto deadline =
      std::chrono::steady_clock::now() + std::chrono::minutes{argc == 4 ? std::atoi(argv[3]) : 5};
  while (signal.wait_until(deadline, [&] { return stopped || !received.empty(); })) {
    if (signal.locked([&] { return stopped; })) return 0;
    for (const auto& outcome : signal.locked([&] { return std::exchange(received, {}); })) {
      writer.write(outcome);
    }
  }
  return 1;
}
