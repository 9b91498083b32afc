// Checks a lab before or during a run and reports what is missing and what to do.
#include <algorithm>
#include <atomic>
#include <iostream>
#include <iterator>
#include <optional>
#include <vector>

#include "hlc_bridge/apps/flags.hpp"
#include "hlc_bridge/apps/program_version.hpp"
#include "hlc_bridge/doctor/listen.hpp"
#include "hlc_bridge/doctor/shared_memory.hpp"
#include "hlc_bridge/messages/exit_codes.hpp"
#include "hlc_bridge/time/real_time.hpp"
#include "hlc_bridge/time/stop_signals.hpp"

namespace {

/// For what is missing: discovery takes its time on a busy machine.
constexpr std::chrono::seconds kPatience{10};

struct Flags {
  hlc::apps::NetworkFlags network;
  std::vector<int> vehicle_ids;
  std::optional<int> middleware_domain;
  std::optional<int> controller_domain;
  std::vector<std::string> controller_peers;
  double listen_s{3.0};
};

void declare(CLI::App& app, Flags& flags) {
  app.add_option("--vehicle_ids", flags.vehicle_ids, "vehicles that take part, e.g. 1,2,3")
      ->delimiter(',')
      ->required()
      ->check(hlc::apps::vehicle_id_range());
  app.add_option("--middleware_domain", flags.middleware_domain,
                 "local domain of this machine; default: no check of the middleware");
  app.add_option("--controller_domain", flags.controller_domain,
                 "domain of the controllers; default: lab domain + 50");
  hlc::apps::declare_controller_peers(app, flags.controller_peers);
  app.add_option(
         "--listen_s", flags.listen_s,
         "how long to listen, from the first state of every vehicle on; for what is missing "
         "10 s longer")
      ->capture_default_str()
      ->check(hlc::apps::within(0.5, 600.0));
  flags.network.declare_network(app);
  hlc::apps::declare_help_end(
      app, {.examples = {"lab_doctor --vehicle_ids 1,2,3",
                         "lab_doctor --vehicle_ids 1 --dds_domain 40 --middleware_domain 41 "
                         "--transport loopback --listen_s 10"},
            .exit_codes = "0 no bad finding, 1 a bad finding, 2 invalid input or an output that "
                          "cannot be written"});
}

hlc::doctor::ListenOptions listen_options(const Flags& flags) {
  const hlc::apps::NetworkFlags& network = flags.network;
  hlc::doctor::ListenOptions options;
  options.transport = hlc::dds::transport_from_name(network.transport);
  options.domains = {.lab = network.dds_domain,
                     .local = flags.middleware_domain,
                     .controller = flags.controller_domain
                                       ? *flags.controller_domain
                                       : hlc::dds::default_controller_domain(network.dds_domain)};
  options.discovery_server = network.discovery_server();
  options.security = network.security;
  hlc::dds::check_addresses("--controller_peers", flags.controller_peers);
  options.controller_peers = flags.controller_peers;
  options.time = kPatience + std::chrono::milliseconds{static_cast<int>(1000.0 * flags.listen_s)};
  return options;
}

/// @return true if no finding is bad
bool print(const std::vector<hlc::doctor::Finding>& findings) {
  bool is_good = true;
  for (const hlc::doctor::Finding& finding : findings) {
    const char* const mark = finding.verdict == hlc::doctor::Verdict::kGood   ? "good"
                             : finding.verdict == hlc::doctor::Verdict::kNote ? "note"
                                                                              : "BAD ";
    std::cout << mark << "  " << finding.what << '\n';
    if (!finding.advice.empty()) std::cout << "      -> " << finding.advice << '\n';
    is_good = is_good && finding.verdict != hlc::doctor::Verdict::kBad;
  }
  return is_good;
}

}  // namespace

int main(int argc, char** argv) {
  hlc::time::StopSignals signals;
  hlc::apps::CommandLine app{
      "Checks a lab before or during a run: participants, leftovers, remedies.", "lab_doctor"};
  Flags flags;
  declare(app, flags);
  if (const auto code = hlc::apps::parse_flags(app, argc, argv)) return *code;
  std::atomic<bool> stop{false};
  bool is_good = true;
  const int code = hlc::apps::exit_code_of("lab_doctor", [&] {
    hlc::apps::check_each_once("--vehicle_ids", flags.vehicle_ids);
    const hlc::doctor::ListenOptions options = listen_options(flags);
    std::vector<hlc::doctor::Finding> findings{
        {hlc::doctor::Verdict::kGood, "this program: " + hlc::apps::program_version(), ""}};
    for (const std::string& warning : hlc::dds::check_domains(options.domains, options.transport)) {
      findings.push_back({hlc::doctor::Verdict::kNote, warning, ""});
    }
    signals.on_stop([&stop](int) { stop = true; });
    findings.push_back(hlc::doctor::leftovers(hlc::doctor::shared_memory_files()));
    const auto span = static_cast<hlc::Nanoseconds>(1e9 * flags.listen_s);
    const hlc::doctor::Received received =
        hlc::doctor::listen(options, [&](const hlc::doctor::Received& so_far) {
          return stop.load() || hlc::doctor::is_complete(flags.vehicle_ids, so_far,
                                                         hlc::time::real_time_now(), span);
        });
    std::ranges::move(
        hlc::doctor::diagnose(flags.vehicle_ids, received, hlc::apps::program_version()),
        std::back_inserter(findings));
    is_good = print(findings);
  });
  if (code != hlc::kExitGood) return hlc::kExitBadInput;
  return is_good ? 0 : 1;
}
