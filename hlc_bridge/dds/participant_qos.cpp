#include "hlc_bridge/dds/participant_qos.hpp"

#include <memory>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "hlc_bridge/dds/library.hpp"
#include "hlc_bridge/dds/security.hpp"

namespace hlc::dds {
namespace {

using fdds::DomainParticipantQos;
using namespace std::chrono_literals;

constexpr int kAnnouncementsPerLease = 8;
constexpr std::uint32_t kParticipantsPerMachine = 32;     // of one domain, that a peer is asked for
constexpr const char* kMulticastAddress = "239.255.0.1";  // the standard's
constexpr std::uint32_t kSocketBufferBytes = 1U << 20U;   // the system may grant less

void set_transport(const ParticipantOptions& options, DomainParticipantQos& qos) {
  const bool loopback = options.transport == Transport::kLoopback;
  qos.transport().use_builtin_transports = false;
  if (!loopback && options.role == DomainRole::kLocal) {
    qos.transport().user_transports = {std::make_shared<SharedMemoryTransport>()};
    return;
  }
  auto udp = std::make_shared<UdpTransport>();
  udp->maxInitialPeersRange = kParticipantsPerMachine;
  if (loopback) {
    udp->interfaceWhiteList = {"127.0.0.1"};
    udp->sendBufferSize = kSocketBufferBytes;
    udp->receiveBufferSize = kSocketBufferBytes;
  }
  qos.transport().user_transports = {udp};
}

void set_lease(const ParticipantOptions& options, DomainParticipantQos& qos) {
  auto& discovery = qos.wire_protocol().builtin.discovery_config;
  const std::chrono::nanoseconds lease(options.lease);
  discovery.leaseDuration = to_duration(lease);
  discovery.leaseDuration_announcementperiod = to_duration(lease / kAnnouncementsPerLease);
  discovery.initial_announcements = {5, to_duration(100ms)};
}

// A list of peers replaces multicast, which is to stay in use here.
void set_peers(const ParticipantOptions& options, DomainParticipantQos& qos) {
  if (options.peers.empty()) return;
  auto& initial_peers = qos.wire_protocol().builtin.initialPeersList;
  std::vector<std::string> addresses{kMulticastAddress, "127.0.0.1"};
  addresses.insert(addresses.end(), options.peers.begin(), options.peers.end());
  for (const std::string& address : addresses) {
    frtps::Locator_t locator;  // port 0: those of the domain
    if (!frtps::IPLocator::setIPv4(locator, address)) {
      throw std::invalid_argument("peer \"" + address + "\", must be an IPv4 address");
    }
    initial_peers.push_back(locator);
  }
}

// As in the lab's own clients.
void set_discovery(const ParticipantOptions& options, DomainParticipantQos& qos) {
  auto& discovery = qos.wire_protocol().builtin.discovery_config;
  discovery.discoveryProtocol = frtps::DiscoveryProtocol::SIMPLE;
  if (options.discovery_server && !options.security.empty()) {
    throw std::invalid_argument(
        "--security with --discovery_mode = client, must be simple: the library refuses both");
  }
  if (!options.discovery_server) {
    set_peers(options, qos);
    return;
  }
  if (!options.peers.empty()) {
    throw std::invalid_argument("participant " + options.name +
                                ": peers have no meaning for a client of a discovery server");
  }
  if (options.role == DomainRole::kLocal) {
    throw std::invalid_argument("participant " + options.name +
                                ": the local domain has no discovery server");
  }
  frtps::GuidPrefix_t server;
  if (!(std::istringstream(options.discovery_server->guid_prefix) >> server)) {
    throw std::invalid_argument("discovery server id \"" + options.discovery_server->guid_prefix +
                                "\": 12 bytes in hexadecimal with dots between them");
  }
  frtps::Locator_t address;
  frtps::IPLocator::setIPv4(address, options.discovery_server->ip);
  address.port = options.discovery_server->port;
  if (options.is_discovery_server) {
    discovery.discoveryProtocol = frtps::DiscoveryProtocol::SERVER;
    qos.wire_protocol().prefix = server;
    qos.wire_protocol().builtin.metatrafficUnicastLocatorList.push_back(address);
    return;
  }
  discovery.discoveryProtocol = frtps::DiscoveryProtocol::CLIENT;
  add_discovery_server(discovery, server, address);
  discovery.discoveryServer_client_syncperiod = to_duration(250ms);
  // Any free port, unicast: a client needs no multicast.
  qos.wire_protocol().builtin.metatrafficUnicastLocatorList.push_back(frtps::Locator_t{});
}

void set_security(const ParticipantOptions& options, DomainParticipantQos& qos) {
  if (options.security.empty()) return;
  const SecurityFiles files = security_files(options.security, identity_of(options.name));
  auto& properties = qos.properties().properties();
  const auto set = [&](const std::string& name, const std::string& value) {
    properties.emplace_back("dds.sec." + name, value);
  };
  const auto set_file = [&](const std::string& name, const std::filesystem::path& file) {
    set(name, "file://" + file.string());
  };
  set("auth.plugin", "builtin.PKI-DH");
  set_file("auth.builtin.PKI-DH.identity_ca", files.authority);
  set_file("auth.builtin.PKI-DH.identity_certificate", files.certificate);
  set_file("auth.builtin.PKI-DH.private_key", files.key);
  set("access.plugin", "builtin.Access-Permissions");
  set_file("access.builtin.Access-Permissions.permissions_ca", files.authority);
  set_file("access.builtin.Access-Permissions.governance", files.governance);
  set_file("access.builtin.Access-Permissions.permissions", files.permissions);
  set("crypto.plugin", "builtin.AES-GCM-GMAC");
}

}  // namespace

DomainParticipantQos participant_qos(const ParticipantOptions& options) {
  DomainParticipantQos qos;
  qos.name(options.name);
  qos.user_data().data_vec({options.version.begin(), options.version.end()});
  set_transport(options, qos);
  set_lease(options, qos);
  set_discovery(options, qos);
  set_security(options, qos);
  return qos;
}

}  // namespace hlc::dds
