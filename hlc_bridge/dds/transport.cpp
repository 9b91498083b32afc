#include "hlc_bridge/dds/transport.hpp"

#include <arpa/inet.h>
#include <fmt/format.h>

#include <cctype>
#include <charconv>
#include <stdexcept>

namespace hlc::dds {
namespace {

/// 12 bytes in hexadecimal with dots between them. Without <regex>, which takes seconds to compile.
bool is_guid_prefix(const std::string& text) {
  constexpr std::size_t kLength = 12 * 3 - 1;
  if (text.size() != kLength) return false;
  for (std::size_t i = 0; i < kLength; ++i) {
    if (i % 3 == 2 ? text[i] != '.' : std::isxdigit(static_cast<unsigned char>(text[i])) == 0) {
      return false;
    }
  }
  return true;
}

/// @param what  value and bound
[[noreturn]] void refuse_flag(const std::string& flag, const std::string& what) {
  throw std::invalid_argument(flag + ": " + what);
}

void refuse_equal(const char* first_flag, const std::optional<int>& first, const char* second_flag,
                  const std::optional<int>& second) {
  if (first && second && *first == *second) {
    refuse_flag(second_flag,
                fmt::format("{}, must be different from {} {}", *second, first_flag, *first));
  }
}

}  // namespace

Transport transport_from_name(const std::string& name) {
  if (name == "loopback") return Transport::kLoopback;
  if (name == "lab") return Transport::kLab;
  refuse_flag("--transport", fmt::format("\"{}\", must be lab or loopback", name));
}

void check_domain_id(const std::string& flag, int id) {
  if (id < kMinDomainId || id > kMaxDomainId) {
    refuse_flag(flag, fmt::format("{}, must be in {} ... {}", id, kMinDomainId, kMaxDomainId));
  }
}

std::vector<std::string> check_domains(const Domains& domains, Transport transport) {
  if (domains.lab) {
    check_domain_id("--dds_domain", *domains.lab);
  }
  if (domains.local) {
    check_domain_id("--middleware_domain", *domains.local);
  }
  if (domains.controller) {
    check_domain_id("--controller_domain", *domains.controller);
  }
  refuse_equal("--dds_domain", domains.lab, "--controller_domain", domains.controller);
  refuse_equal("--middleware_domain", domains.local, "--controller_domain", domains.controller);
  if (transport == Transport::kLab && domains.lab && domains.lab == domains.local) {
    return {
        fmt::format("--middleware_domain: {} is also --dds_domain; this works only because they "
                    "use different transports",
                    *domains.local)};
  }
  refuse_equal("--dds_domain", domains.lab, "--middleware_domain", domains.local);
  return {};
}

int default_controller_domain(int lab_domain) {
  check_domain_id("--dds_domain", lab_domain);
  const int domain = lab_domain + 50;
  if (domain > 100) {
    refuse_flag(
        "--controller_domain",
        fmt::format("the default --dds_domain + 50 = {}, must be <= 100, or given", domain));
  }
  return domain;
}

void check_addresses(const std::string& flag, const std::vector<std::string>& addresses) {
  for (const std::string& address : addresses) {
    in_addr parsed{};
    if (inet_pton(AF_INET, address.c_str(), &parsed) != 1) {
      refuse_flag(flag, fmt::format("\"{}\", must be an IPv4 address", address));
    }
  }
}

std::optional<DiscoveryServer> discovery_from_flags(const std::string& mode,
                                                    const std::string& server_id,
                                                    const std::string& server_ip,
                                                    const std::string& server_port) {
  if (mode != "client") {
    if (mode.empty() && !(server_id + server_ip + server_port).empty()) {
      refuse_flag("--discovery_mode",
                  fmt::format("\"{}\", must be client with a discovery server", mode));
    }
    return std::nullopt;
  }
  if (!is_guid_prefix(server_id)) {
    refuse_flag(
        "--discovery_server_id",
        fmt::format("\"{}\", must be 12 bytes in hexadecimal with dots between them", server_id));
  }
  check_addresses("--discovery_server_ip", {server_ip});
  DiscoveryServer server{server_id, server_ip, 0};
  const char* const end = server_port.data() + server_port.size();
  const auto [parsed_end, error] = std::from_chars(server_port.data(), end, server.port);
  if (error != std::errc{} || parsed_end != end || server.port == 0) {
    refuse_flag("--discovery_server_port",
                fmt::format("\"{}\", must be in 1 ... 65535", server_port));
  }
  return server;
}

}  // namespace hlc::dds
