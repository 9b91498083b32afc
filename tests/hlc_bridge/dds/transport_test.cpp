#include "hlc_bridge/dds/transport.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <stdexcept>

namespace hlc::dds::transport_test {
namespace {

// The message of the refusal; "" if there is none.
std::string refusal(const std::function<void()>& call) {
  try {
    call();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(Transport, IsKnownByName) {
  EXPECT_EQ(transport_from_name("lab"), Transport::kLab);
  EXPECT_EQ(transport_from_name("loopback"), Transport::kLoopback);
  EXPECT_EQ(refusal([] { static_cast<void>(transport_from_name("udp")); }),
            "--transport: \"udp\", must be lab or loopback");
}

TEST(Domains, IdsAreFrom0To232) {
  for (const int id : {0, 1, 100, 232}) {
    EXPECT_NO_THROW(check_domain_id("--dds_domain", id));
  }
  EXPECT_EQ(refusal([] { check_domain_id("--dds_domain", 233); }),
            "--dds_domain: 233, must be in 0 ... 232");
  EXPECT_THROW(check_domain_id("--dds_domain", -1), std::invalid_argument);
}

TEST(Domains, EveryNumberOfAProcessIsChecked) {
  const auto flag = [](const Domains& domains) {
    const std::string text =
        refusal([&] { static_cast<void>(check_domains(domains, Transport::kLoopback)); });
    return text.substr(0, text.find(':'));
  };
  EXPECT_EQ(flag({.lab = 300, .local = 1, .controller = 2}), "--dds_domain");
  EXPECT_EQ(flag({.lab = 0, .local = -1, .controller = 2}), "--middleware_domain");
  EXPECT_EQ(flag({.lab = 0, .local = 1, .controller = 233}), "--controller_domain");
  EXPECT_EQ(flag({.lab = 3, .local = 3, .controller = 4}), "--middleware_domain");
  EXPECT_EQ(flag({.lab = 3, .local = 4, .controller = 3}), "--controller_domain");
  EXPECT_EQ(flag({.lab = 3, .local = 4, .controller = 4}), "--controller_domain");
  EXPECT_EQ(flag({.lab = 3, .local = 4, .controller = 5}), "");
  EXPECT_EQ(flag({.lab = 3, .local = {}, .controller = {}}), "");
}

TEST(Domains, LabEqualToLocalIsAWarningInTheLab) {
  EXPECT_EQ(check_domains({.lab = 21, .local = 21, .controller = 71}, Transport::kLab).size(), 1U);
  EXPECT_TRUE(check_domains({.lab = 21, .local = 22, .controller = 71}, Transport::kLab).empty());
  EXPECT_THROW(
      static_cast<void>(check_domains({.lab = 21, .local = 22, .controller = 22}, Transport::kLab)),
      std::invalid_argument);
}

TEST(Domains, ControllerDomainDefaultsTo50AboveTheLabDomainUpTo100) {
  EXPECT_EQ(default_controller_domain(0), 50);
  EXPECT_EQ(default_controller_domain(50), 100);
  EXPECT_THROW(static_cast<void>(default_controller_domain(51)), std::invalid_argument);
}

constexpr const char* kId = "44.53.00.5f.45.50.52.4f.53.49.4d.41";

TEST(DiscoveryFlags, NoneMeansSimple) {
  EXPECT_FALSE(discovery_from_flags("", "", "", "").has_value());
  EXPECT_FALSE(discovery_from_flags("simple", "", "", "").has_value());
}

TEST(DiscoveryFlags, AClientIsDescribedByAllFour) {
  const auto server = discovery_from_flags("client", kId, "192.168.1.249", "11811");
  ASSERT_TRUE(server.has_value());
  EXPECT_EQ(server->guid_prefix, kId);
  EXPECT_EQ(server->ip, "192.168.1.249");
  EXPECT_EQ(server->port, 11811);
}

TEST(DiscoveryFlags, IncompleteOrMalformedOnesAreRefusedByName) {
  const auto flag = [](const char* mode, const char* id, const char* ip, const char* port) {
    const std::string text =
        refusal([&] { static_cast<void>(discovery_from_flags(mode, id, ip, port)); });
    return text.substr(0, text.find(':'));
  };
  EXPECT_EQ(flag("", kId, "127.0.0.1", "11811"), "--discovery_mode");
  EXPECT_EQ(flag("client", "", "127.0.0.1", "11811"), "--discovery_server_id");
  EXPECT_EQ(flag("client", "44.53", "127.0.0.1", "11811"), "--discovery_server_id");
  for (const std::string& id : {std::string(kId) + ".41", std::string(kId) + "4",
                                "x" + std::string(kId).substr(1), std::string(35, '4')}) {
    EXPECT_EQ(flag("client", id.c_str(), "127.0.0.1", "11811"), "--discovery_server_id") << id;
  }
  EXPECT_EQ(flag("client", kId, "", "11811"), "--discovery_server_ip");
  EXPECT_EQ(flag("client", kId, "lab-pc", "11811"), "--discovery_server_ip");
  EXPECT_EQ(flag("client", kId, "127.0.0.1", ""), "--discovery_server_port");
  EXPECT_EQ(flag("client", kId, "127.0.0.1", "0"), "--discovery_server_port");
  EXPECT_EQ(flag("client", kId, "127.0.0.1", "70000"), "--discovery_server_port");
  EXPECT_EQ(flag("client", kId, "127.0.0.1", "118x"), "--discovery_server_port");
}

}  // namespace
}  // namespace hlc::dds::transport_test
