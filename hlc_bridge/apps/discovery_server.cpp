// Discovery server for the lab domain, for networks without multicast in which no lab control
// centre runs one. Debian's own (fast-discovery-server 2.9.1) crashes on the lab's types, which it
// does not know.
#include <arpa/inet.h>
#include <fmt/format.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <iostream>
#include <memory>
#include <stdexcept>

#include "hlc_bridge/apps/flags.hpp"
#include "hlc_bridge/apps/run_program.hpp"
#include "hlc_bridge/dds/participant.hpp"
#include "hlc_bridge/time/signal.hpp"

namespace {

struct Flags {
  int dds_domain{0};
  std::string id{hlc::apps::kDiscoveryServerId};
  std::string ip;
  std::string port{hlc::apps::kDiscoveryServerPort};
  std::string transport{"lab"};
};

void declare(CLI::App& app, Flags& flags) {
  app.add_option("--dds_domain", flags.dds_domain, "lab domain")->capture_default_str();
  app.add_option("--discovery_server_id", flags.id, "GUID prefix")->capture_default_str();
  app.add_option("--discovery_server_ip", flags.ip,
                 "IPv4 address of this machine at which the others reach it")
      ->required();
  app.add_option("--discovery_server_port", flags.port, "UDP port")->capture_default_str();
  hlc::apps::declare_transport(app, flags.transport);
  hlc::apps::declare_log_level(app);
  hlc::apps::declare_help_end(
      app, {.examples = {"discovery_server --discovery_server_ip 192.168.1.249",
                         "discovery_server --discovery_server_ip 127.0.0.1 --dds_domain 40 "
                         "--transport loopback"},
            .exit_codes = "0 stopped, 2 invalid input",
            .notes = "Runs until it is stopped. The others find each other through it with "
                     "--discovery_mode=client and the same --discovery_server_... flags."});
}

/// The library reports nothing for an address that it cannot serve.
/// @throws std::invalid_argument
void check_can_listen(const std::string& ip, std::uint16_t port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  inet_pton(AF_INET, ip.c_str(), &address.sin_addr);
  const int listener = socket(AF_INET, SOCK_DGRAM, 0);
  const int result = bind(listener, reinterpret_cast<const sockaddr*>(&address), sizeof address);
  const int error = errno;
  close(listener);
  if (result == 0) return;
  if (error == EADDRNOTAVAIL) {
    throw std::invalid_argument("--discovery_server_ip: " + ip +
                                ", must be an address of this machine");
  }
  throw std::invalid_argument(
      fmt::format("--discovery_server_port: {}, must be free on this machine", port));
}

/// Serves until it is stopped.
class Server {
 public:
  explicit Server(const hlc::dds::ParticipantOptions& options) : participant_(options) {}
  int run() {
    while (!signal_.wait_until(std::chrono::steady_clock::now() + std::chrono::hours{1},
                               [this] { return stop_; })) {
    }
    return hlc::kExitGood;
  }
  void stop() {
    signal_.post([this] { stop_ = true; });
  }

 private:
  hlc::dds::Participant participant_;
  hlc::time::Signal signal_;
  bool stop_{};
};

std::shared_ptr<Server> make_server(const Flags& flags) {
  hlc::dds::ParticipantOptions options;
  options.name = "discovery_server";
  hlc::dds::check_domain_id("--dds_domain", flags.dds_domain);
  options.domain_id = flags.dds_domain;
  options.role = hlc::dds::DomainRole::kLab;
  options.transport = hlc::dds::transport_from_name(flags.transport);
  options.discovery_server =
      hlc::dds::discovery_from_flags("client", flags.id, flags.ip, flags.port);
  options.is_discovery_server = true;
  check_can_listen(options.discovery_server->ip, options.discovery_server->port);
  auto server = std::make_shared<Server>(options);
  std::cout << "discovery_server: serves domain " << flags.dds_domain << " at " << flags.ip << ":"
            << flags.port << std::endl;
  return server;
}

}  // namespace

int main(int argc, char** argv) {
  hlc::time::StopSignals signals;
  hlc::apps::CommandLine app{"Introduces the participants of the lab domain to each other.",
                             "discovery_server"};
  Flags flags;
  declare(app, flags);
  if (const auto code = hlc::apps::parse_flags(app, argc, argv)) return *code;
  return hlc::apps::run_program(
      "discovery_server", signals, [&] { return make_server(flags); },
      [](Server& server) { server.stop(); });
}
