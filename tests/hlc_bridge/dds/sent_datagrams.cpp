#include "tests/hlc_bridge/dds/sent_datagrams.hpp"

#include <dlfcn.h>
#include <sys/socket.h>

#include <mutex>
#include <optional>

namespace hlc::dds {
namespace {

std::mutex mutex;
std::optional<std::vector<Datagram>> sent;  // guarded by mutex; none: not recorded

void record(const void* address, socklen_t size, const iovec* pieces, std::size_t count) {
  const std::lock_guard lock{mutex};
  if (!sent || address == nullptr || size != sizeof(sockaddr_in)) return;
  Datagram datagram;
  datagram.to = *static_cast<const sockaddr_in*>(address);
  if (datagram.to.sin_family != AF_INET) return;
  for (std::size_t i = 0; i < count; ++i) {
    const auto* begin = static_cast<const unsigned char*>(pieces[i].iov_base);
    datagram.bytes.insert(datagram.bytes.end(), begin, begin + pieces[i].iov_len);
  }
  sent->push_back(datagram);
}

}  // namespace

SentDatagrams::SentDatagrams() {
  const std::lock_guard lock{mutex};
  sent.emplace();
}

SentDatagrams::~SentDatagrams() {
  const std::lock_guard lock{mutex};
  sent.reset();
}

std::vector<Datagram> SentDatagrams::so_far() const {
  const std::lock_guard lock{mutex};
  return *sent;
}

}  // namespace hlc::dds

extern "C" {

ssize_t sendmsg(int socket, const msghdr* message, int flags) {
  static const auto kSystemCall =
      reinterpret_cast<ssize_t (*)(int, const msghdr*, int)>(dlsym(RTLD_NEXT, "sendmsg"));
  hlc::dds::record(message->msg_name, message->msg_namelen, message->msg_iov, message->msg_iovlen);
  return kSystemCall(socket, message, flags);
}

ssize_t sendto(int socket, const void* bytes, size_t size, int flags, const sockaddr* address,
               socklen_t address_size) {
  static const auto kSystemCall =
      reinterpret_cast<ssize_t (*)(int, const void*, size_t, int, const sockaddr*, socklen_t)>(
          dlsym(RTLD_NEXT, "sendto"));
  const iovec piece{const_cast<void*>(bytes), size};
  hlc::dds::record(address, address_size, &piece, 1);
  return kSystemCall(socket, bytes, size, flags, address, address_size);
}

}  // extern "C"
