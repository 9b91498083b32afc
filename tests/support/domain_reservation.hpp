#pragma once

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace hlc::test {

/// The lock of a domain, as launch_scripts/domain_locks.sh has it: in /tmp/hlc-<user id>, which is
/// created, or else in $XDG_RUNTIME_DIR. @throws std::runtime_error if neither is a private folder
inline std::string domain_lock_file(int domain) {
  const auto is_private = [](const std::string& folder) {
    struct stat status {};
    return lstat(folder.c_str(), &status) == 0 && S_ISDIR(status.st_mode) &&
           status.st_uid == geteuid() && (status.st_mode & 07777U) == 0700U;
  };
  std::string folder = "/tmp/hlc-" + std::to_string(geteuid());
  mkdir(folder.c_str(), 0700);
  if (!is_private(folder)) {
    const char* const runtime = std::getenv("XDG_RUNTIME_DIR");
    if (runtime == nullptr || !is_private(runtime)) {
      throw std::runtime_error(folder + " must be a private folder");
    }
    folder = runtime;
  }
  return folder + "/hlc_dds_domain_" + std::to_string(domain) + ".lock";
}

/// Whether a participant, of whatever process, is on the domain: every one is discovered by this
/// port.
inline bool has_participant(int domain) {
  std::ostringstream port;
  port << ':' << std::hex << std::uppercase << 7400 + 250 * domain;
  for (const char* const file : {"/proc/net/udp", "/proc/net/udp6"}) {
    std::ifstream sockets(file);
    std::string slot;
    std::string address;
    for (std::string line; std::getline(sockets, line);) {
      std::istringstream(line) >> slot >> address;
      if (address.ends_with(port.str())) return true;
    }
  }
  return false;
}

/// Consecutive DDS domains that no other test on this machine uses during the lifetime of this
/// object: locks, and no participant. The domains are first() ... first() + count - 1, all in 1 ...
/// 50, and with each the one 50 above it (the default controller domain), so that none is above
/// 100.
class DomainReservation {
 public:
  /// Waits up to a minute for room; throws std::runtime_error after that.
  explicit DomainReservation(int count = 1) {
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::minutes{1};
    while (!reserve(count)) {
      if (std::chrono::steady_clock::now() > deadline) {
        throw std::runtime_error("no " + std::to_string(count) + " free DDS domains");
      }
      std::this_thread::sleep_for(std::chrono::milliseconds{100});
    }
  }
  ~DomainReservation() { release(); }
  DomainReservation(const DomainReservation&) = delete;
  DomainReservation& operator=(const DomainReservation&) = delete;

  [[nodiscard]] int first() const { return first_; }

 private:
  static constexpr int kDomains = 50;

  // Looks at the domains from a place that differs from process to process.
  bool reserve(int count) {
    const int starts = kDomains - count + 1;
    for (int i = 0; i < starts; ++i) {
      first_ = 1 + (static_cast<int>(getpid()) + i) % starts;
      if (lock_all(count)) {
        return true;
      }
    }
    return false;
  }

  bool lock_all(int count) {
    for (int domain = first_; domain < first_ + count; ++domain) {
      const int fd =
          open(domain_lock_file(domain).c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC, 0600);
      locks_.push_back(fd);
      if (fd < 0 || flock(fd, LOCK_EX | LOCK_NB) != 0 || has_participant(domain) ||
          has_participant(domain + 50)) {
        release();
        return false;
      }
    }
    return true;
  }

  void release() {
    for (const int fd : locks_) {
      if (fd >= 0) close(fd);
    }
    locks_.clear();
  }

  int first_{};
  std::vector<int> locks_;
};

}  // namespace hlc::test
