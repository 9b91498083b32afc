#pragma once

#include <netinet/in.h>
#include <sys/socket.h>

#include <cstddef>
#include <cstdint>

namespace hlc::dds {

/// To a port of 127.0.0.1. @param socket  for datagrams, AF_INET
inline void send_datagram(int socket, const void* bytes, std::size_t size, int port) {
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_port = htons(static_cast<std::uint16_t>(port));
  to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  ::sendto(socket, bytes, size, 0, reinterpret_cast<const sockaddr*>(&to), sizeof to);
}

}  // namespace hlc::dds
