#pragma once

#include <netinet/in.h>

#include <vector>

namespace hlc::dds {

struct Datagram {
  std::vector<unsigned char> bytes;
  sockaddr_in to{};
};

/// The datagrams that the library sends from this process over IPv4 during the lifetime of the
/// object: sendto and sendmsg of this program take the place of the system's, and call them. One
/// object at a time.
class SentDatagrams {
 public:
  SentDatagrams();
  ~SentDatagrams();
  SentDatagrams(const SentDatagrams&) = delete;
  SentDatagrams& operator=(const SentDatagrams&) = delete;

  [[nodiscard]] std::vector<Datagram> so_far() const;
};

}  // namespace hlc::dds
