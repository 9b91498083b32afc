#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace hlc::dds {

/// How the participants of a run reach each other.
enum class Transport : std::uint8_t {
  kLoopback,  ///< UDP on 127.0.0.1 only, every topic reliable; leaves nothing in /dev/shm
  kLab,       ///< as the lab's processes: lab domain UDP, local domain shared memory only,
              ///< controller domain UDP; reliability and histories as in the lab
};

/// "loopback" or "lab"; throws std::invalid_argument for anything else.
[[nodiscard]] Transport transport_from_name(const std::string& name);

/// Purpose of a domain; it determines transport and quality of service.
enum class DomainRole : std::uint8_t {
  kLab,         ///< lab control, middleware, vehicles, controllers
  kLocal,       ///< one middleware and its controller
  kController,  ///< the controllers and lab control
};

/// Numbers of a process's domains; those that it does not join are empty.
struct Domains {
  std::optional<int> lab;
  std::optional<int> local;
  std::optional<int> controller;
};

inline constexpr int kMinDomainId = 0;
inline constexpr int kMaxDomainId = 232;  ///< the library ends the whole process at 233

/// Throws std::invalid_argument naming `flag` unless kMinDomainId <= id <= kMaxDomainId.
void check_domain_id(const std::string& flag, int id);

/// Throws std::invalid_argument for a number out of range and for two equal numbers. Lab = local is
/// accepted with Transport::kLab, as in the lab (vehicle 21 on lab domain 21). Returns warnings,
/// one line each.
[[nodiscard]] std::vector<std::string> check_domains(const Domains& domains, Transport transport);

/// Lab domain + 50, the default of --controller_domain. Throws std::invalid_argument if that is
/// above 100, where ports can collide with ephemeral ports of the system: then it must be given.
[[nodiscard]] int default_controller_domain(int lab_domain);

/// The server through which a client discovers the others where multicast does not work (lab wire
/// contract, 1).
struct DiscoveryServer {
  std::string guid_prefix;  ///< "44.53.00.5f.45.50.52.4f.53.49.4d.41": 12 bytes in hexadecimal
  std::string ip;           ///< IPv4
  std::uint16_t port{};
};

/// The lab's flags --discovery_mode, --discovery_server_id, --discovery_server_ip,
/// --discovery_server_port as given ("" if not). Nothing if none is given or the mode is "simple";
/// throws std::invalid_argument naming the flag if the mode is "client" and something is missing or
/// malformed, or if the mode is missing.
/// @pre the mode is "", "simple" or "client"
[[nodiscard]] std::optional<DiscoveryServer> discovery_from_flags(const std::string& mode,
                                                                  const std::string& server_id,
                                                                  const std::string& server_ip,
                                                                  const std::string& server_port);

/// Throws std::invalid_argument naming `flag` unless every address is an IPv4 address.
void check_addresses(const std::string& flag, const std::vector<std::string>& addresses);

}  // namespace hlc::dds
