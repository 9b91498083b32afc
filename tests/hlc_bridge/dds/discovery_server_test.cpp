#include <gtest/gtest.h>

#include <stdexcept>

#include "hlc_bridge/dds/writer.hpp"
#include "tests/hlc_bridge/dds/loopback.hpp"
#include "tests/support/domain_reservation.hpp"

namespace hlc::dds::discovery_server_test {
namespace {

constexpr const char* kServerId = "44.53.00.5f.45.50.52.4f.53.49.4d.41";

/// The port is one of the domain's own, above those of participants.
ParticipantOptions through_server(const std::string& name, int domain) {
  ParticipantOptions options = on_loopback(name, domain, DomainRole::kLab);
  options.discovery_server = {kServerId, "127.0.0.1",
                              static_cast<std::uint16_t>(7400 + 250 * domain + 249)};
  return options;
}

ParticipantOptions server_of(int domain) {
  ParticipantOptions options = through_server("discovery_server", domain);
  options.is_discovery_server = true;
  return options;
}

TEST(DiscoveryServer, ClientsFindEachOtherThroughIt) {
  const test::DomainReservation domain;
  const Participant server{server_of(domain.first())};
  Participant vehicle{through_server("vehicle_raspberry_1", domain.first())};
  Participant middleware{through_server("middleware_1", domain.first())};
  Mailbox<VehicleState> mailbox{middleware, topics::vehicle_state(1)};
  Writer<VehicleState> writer{vehicle, topics::vehicle_state(1)};
  ASSERT_TRUE(writer.wait_for_matched({"middleware_1"}, soon()));
  ASSERT_TRUE(writer.write(VehicleState{}));
  EXPECT_EQ(mailbox.wait_for(1).size(), 1U);
}

TEST(DiscoveryServer, ClientsDoNotFindEachOtherWithoutIt) {
  const test::DomainReservation domain;
  const Participant vehicle{through_server("vehicle_raspberry_1", domain.first())};
  const Participant middleware{through_server("middleware_1", domain.first())};
  // What must not happen is given a second to happen.
  EXPECT_FALSE(vehicle.wait_for({"middleware_1"},
                                std::chrono::steady_clock::now() + std::chrono::seconds{1}));
  EXPECT_TRUE(middleware.alive().empty());
}

TEST(Peers, AreFoundAsWell) {
  const test::DomainReservation domain;
  ParticipantOptions options =
      on_loopback("high_level_controller_1", domain.first(), DomainRole::kController);
  options.peers = {"127.0.0.1"};
  const Participant first{options};
  options.name = "high_level_controller_2";
  const Participant second{options};
  const Participant other{on_loopback("lab_control", domain.first(), DomainRole::kController)};
  EXPECT_TRUE(first.wait_for({"high_level_controller_2", "lab_control"}, soon()));
  EXPECT_TRUE(other.wait_for({"high_level_controller_1", "high_level_controller_2"}, soon()));
}

TEST(Peers, AreAddressesAndNotForClientsOfAServer) {
  const test::DomainReservation domain;
  ParticipantOptions options = on_loopback("a", domain.first(), DomainRole::kController);
  options.peers = {"lab-pc"};
  EXPECT_THROW(Participant{options}, std::invalid_argument);
  options = through_server("a", domain.first());
  options.peers = {"127.0.0.1"};
  EXPECT_THROW(Participant{options}, std::invalid_argument);
}

}  // namespace
}  // namespace hlc::dds::discovery_server_test
