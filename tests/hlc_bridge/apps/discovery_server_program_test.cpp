#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <string>

#include "hlc_bridge/messages/exit_codes.hpp"
#include "tests/support/program.hpp"

namespace hlc::test {
namespace {

void expect_refused(const std::string& flags, const std::string& line) {
  const Outcome outcome = run_program("discovery_server --dds_domain=1 " + flags);
  EXPECT_EQ(outcome.exit_code, kExitBadInput);
  EXPECT_NE(outcome.output.find(line), std::string::npos) << outcome.output;
  EXPECT_EQ(std::ranges::count(outcome.output, '\n'), 1) << outcome.output;
}

TEST(DiscoveryServerProgram, RefusesAnAddressThatIsNotThisMachines) {
  expect_refused("--discovery_server_ip=192.0.2.1",  // for documentation: unassigned
                 "--discovery_server_ip: 192.0.2.1, must be an address of this machine");
}

TEST(DiscoveryServerProgram, RefusesAPortThatSomebodyHas) {
  const int holder = socket(AF_INET, SOCK_DGRAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  auto* const bound = reinterpret_cast<sockaddr*>(&address);
  ASSERT_EQ(bind(holder, bound, size), 0);
  ASSERT_EQ(getsockname(holder, bound, &size), 0);
  const std::string port = std::to_string(ntohs(address.sin_port));
  expect_refused("--discovery_server_ip=127.0.0.1 --discovery_server_port=" + port,
                 "--discovery_server_port: " + port + ", must be free on this machine");
  close(holder);
}

}  // namespace
}  // namespace hlc::test
