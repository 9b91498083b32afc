#include "hlc_bridge/doctor/listen.hpp"

#include <list>
#include <map>
#include <memory>
#include <utility>
#include <variant>

#include "hlc_bridge/dds/participant.hpp"
#include "hlc_bridge/dds/reader.hpp"
#include "hlc_bridge/dds/writer.hpp"
#include "hlc_bridge/messages/run_parameters.hpp"
#include "hlc_bridge/time/real_time.hpp"
#include "hlc_bridge/time/signal.hpp"

namespace hlc::doctor {
namespace {

constexpr const char* kName = "lab_doctor";
constexpr std::uint8_t kVehicles = 30;  // the most that a lab has
constexpr std::chrono::milliseconds kRequestPause{500};

dds::Participant on_domain(const ListenOptions& options, std::optional<int> domain,
                           dds::DomainRole role) {
  return dds::Participant(
      {.name = kName,
       .domain_id = domain.value(),
       .role = role,
       .transport = options.transport,
       .discovery_server = role == dds::DomainRole::kLab ? options.discovery_server : std::nullopt,
       .peers = role == dds::DomainRole::kController ? options.controller_peers
                                                     : std::vector<std::string>{},
       .security = options.security});
}

void note(const Parameter& parameter, Received& received) {
  received.lab_control_answers = true;
  if (parameter.name != kPeriodParameter) return;
  if (const auto* period_ms = std::get_if<std::uint64_t>(&parameter.value)) {
    received.period_ms = *period_ms;
  }
}

}  // namespace

Received listen(const ListenOptions& options,
                const std::function<bool(const Received&)>& is_enough) {
  time::Signal signal;
  Received received;  // guarded by signal
  const auto begin = std::chrono::steady_clock::now();

  dds::Participant lab = on_domain(options, options.domains.lab, dds::DomainRole::kLab);
  dds::Participant controllers =
      on_domain(options, options.domains.controller, dds::DomainRole::kController);
  std::optional<dds::Participant> local;
  if (options.domains.local) {
    received.listened_to_middleware = true;
    local.emplace(dds::ParticipantOptions{.name = kName,
                                          .domain_id = *options.domains.local,
                                          .role = dds::DomainRole::kLocal,
                                          .transport = options.transport,
                                          .security = options.security});
  }
  dds::Writer<ParameterRequest> requests(lab, dds::topics::parameter_request());
  const dds::Reader<Parameter> parameters(
      lab, dds::topics::parameter(),
      [&](const Parameter& parameter) { signal.post([&] { note(parameter, received); }); });
  std::list<dds::Reader<VehicleState>> states;
  for (std::uint8_t id = 1; id <= kVehicles; ++id) {
    states.emplace_back(lab, dds::topics::vehicle_state(id), [&](const VehicleState& state) {
      const Nanoseconds now = time::real_time_now();
      signal.post([&] { note(state, now, received); });
    });
  }
  std::optional<dds::Reader<VehicleStateList>> lists;
  if (local) {
    lists.emplace(*local, dds::topics::vehicle_state_list(), [&](const VehicleStateList& list) {
      const Nanoseconds now = time::real_time_now();
      signal.post([&] { note(list, now, received); });
    });
  }

  const auto is_over = [&] { return is_enough(received); };
  static_cast<void>(signal.repeat_until(begin + options.time, kRequestPause, is_over, [&] {
    requests.write({.name = kPeriodParameter});
    const std::set<std::string> names = controllers.alive();
    std::map<std::string, std::string> versions = lab.versions();
    versions.merge(controllers.versions());
    if (local) versions.merge(local->versions());
    signal.locked([&] {
      received.controllers = names;
      received.versions = std::move(versions);
    });
  }));
  return signal.locked([&] {
    received.ended_at = time::real_time_now();
    return received;
  });
}

}  // namespace hlc::doctor
