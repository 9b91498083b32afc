#include <gtest/gtest.h>

#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastrtps/utils/IPLocator.h>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>

#include "hlc_bridge/dds/library.hpp"
#include "hlc_bridge/dds/participant_core.hpp"
#include "hlc_bridge/dds/writer.hpp"
#include "tests/hlc_bridge/dds/loopback.hpp"
#include "tests/support/domain_reservation.hpp"

namespace hlc {
namespace {

constexpr const char* kServerId = "44.53.00.5f.45.50.52.4f.53.49.4d.41";

/// What the lab control centre runs. The port is one of the domain's own, above those of
/// participants.
class Server {
 public:
  explicit Server(int domain) : port_{static_cast<std::uint16_t>(7400 + 250 * domain + 249)} {
    set_up_library();
    fdds::DomainParticipantQos qos;
    auto& discovery = qos.wire_protocol().builtin.discovery_config;
    discovery.discoveryProtocol = frtps::DiscoveryProtocol::SERVER;
    qos.wire_protocol().prefix = prefix();
    frtps::Locator_t address;
    frtps::IPLocator::setIPv4(address, "127.0.0.1");
    address.port = port_;
    qos.wire_protocol().builtin.metatrafficUnicastLocatorList.push_back(address);
    auto udp = std::make_shared<eprosima::fastdds::rtps::UDPv4TransportDescriptor>();
    udp->interfaceWhiteList = {"127.0.0.1"};
    qos.transport().use_builtin_transports = false;
    qos.transport().user_transports = {udp};
    server_ = fdds::DomainParticipantFactory::get_instance()->create_participant(
        static_cast<fdds::DomainId_t>(domain), qos);
  }
  ~Server() { fdds::DomainParticipantFactory::get_instance()->delete_participant(server_); }
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  [[nodiscard]] bool is_running() const { return server_ != nullptr; }
  [[nodiscard]] DiscoveryServer description() const { return {kServerId, "127.0.0.1", port_}; }

 private:
  static frtps::GuidPrefix_t prefix() {
    eprosima::fastdds::rtps::RemoteServerAttributes attributes;
    attributes.ReadguidPrefix(kServerId);
    return attributes.guidPrefix;
  }

  std::uint16_t port_;
  fdds::DomainParticipant* server_{};
};

TEST(DiscoveryServer, ClientsFindEachOtherThroughIt) {
  const DomainReservation domain;
  const Server server{domain.first()};
  ASSERT_TRUE(server.is_running());
  const auto client = [&](const std::string& name) {
    ParticipantOptions options = on_loopback(name, domain.first(), DomainRole::kLab);
    options.discovery_server = server.description();
    return options;
  };
  Participant vehicle{client("vehicle_raspberry_1")};
  Participant middleware{client("middleware_1")};
  Mailbox<VehicleState> mailbox{middleware, topics::vehicle_state(1)};
  Writer<VehicleState> writer{vehicle, topics::vehicle_state(1)};
  ASSERT_TRUE(writer.wait_for_matched({"middleware_1"}, soon()));
  ASSERT_TRUE(writer.write(VehicleState{}));
  EXPECT_EQ(mailbox.wait_for(1).size(), 1U);
}

}  // namespace
}  // namespace hlc
