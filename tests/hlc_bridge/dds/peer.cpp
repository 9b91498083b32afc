// A process that is there: peer <name> <domain>. Ends cleanly on SIGTERM.

#include <cstdlib>

#include "hlc_bridge/dds/participant.hpp"
#include "hlc_bridge/dds/writer.hpp"
#include "hlc_bridge/time/signal.hpp"
#include "hlc_bridge/time/stop_signals.hpp"

int main(int argc, char** argv) {
  if (argc != 3) {
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
  stop_signals.on_stop([&](int) { signal.post([&] { stopped = true; }); });
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::minutes{5};
  return signal.wait_until(deadline, [&] { return stopped; }) ? 0 : 1;
}
