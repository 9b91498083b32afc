#include "hlc_bridge/live/lab_listener.hpp"

#include <algorithm>
#include <utility>

#include "hlc_bridge/messages/node_names.hpp"

namespace hlc::live {
namespace {

dds::ParticipantOptions participant_options(const ListenerOptions& options, dds::DomainRole role) {
  const bool is_lab = role == dds::DomainRole::kLab;
  dds::ParticipantOptions participant{
      .name = "view",
      .domain_id = is_lab ? options.lab_domain : options.controller_domain,
      .role = role,
      .transport = options.transport,
      .lease = options.lease,
      .security = options.security};
  if (is_lab) {
    participant.discovery_server = options.discovery_server;
  } else {
    participant.peers = options.controller_peers;
  }
  return participant;
}

}  // namespace

LabListener::LabListener(const ListenerOptions& options)
    : vehicle_ids_(options.vehicle_ids),
      lab_(participant_options(options, dds::DomainRole::kLab)),
      controllers_(participant_options(options, dds::DomainRole::kController)),
      reports_(
          controllers_, dds::topics::report(),
          [this](const ReportRecord& record) {
            signal_.post([&] { received_.reports.push_back(record); });
          },
          {}, dds::kItsController) {
  std::vector<std::uint8_t> ids = options.vehicle_ids;
  ids.insert(ids.end(), options.guest_ids.begin(), options.guest_ids.end());
  for (const std::uint8_t id : ids) {
    states_.emplace_back(
        lab_, dds::topics::vehicle_state(id),
        [this](const VehicleState& state) {
          signal_.post([&] { received_.states.push_back(state); });
        },
        nullptr, dds::only(vehicle_name(id)));
  }
}

LabListener::Received LabListener::take() {
  return signal_.locked([this] { return std::exchange(received_, {}); });
}

bool LabListener::run_is_over() const {
  return lab_.is_lost(kLabControlName) || controllers_.is_lost(kLabControlName) ||
         std::ranges::all_of(vehicle_ids_, [this](std::uint8_t id) {
           return controllers_.is_lost(controller_name(id));
         });
}

}  // namespace hlc::live
