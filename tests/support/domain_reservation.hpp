#pragma once

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace hlc::test {

/// Consecutive DDS domains that no other test on this machine uses during the lifetime of this
/// object: lock files /tmp/hlc_dds_domain_<n>.lock. The domains are first() ... first() + count -
/// 1, all in 1 ... 50, and with each the one 50 above it (the default controller domain), so that
/// none is above 100.
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
      const std::string file = "/tmp/hlc_dds_domain_" + std::to_string(domain) + ".lock";
      const int fd = open_shared(file);
      if (fd < 0) {
        release();
        return false;
      }
      locks_.push_back(fd);
      if (flock(fd, LOCK_EX | LOCK_NB) != 0) {
        release();
        return false;
      }
    }
    return true;
  }

  /// Other users lock the same files: they are world-readable, and opened for reading
  /// only, since Linux refuses to open another user's file in /tmp with O_CREAT.
  static int open_shared(const std::string& file) {
    const int present = open(file.c_str(), O_RDONLY | O_CLOEXEC);
    if (present >= 0 || errno != ENOENT) {
      return present;
    }
    const int made = open(file.c_str(), O_RDONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (made < 0) {
      return open(file.c_str(), O_RDONLY | O_CLOEXEC);  // another process was faster
    }
    fchmod(made, 0666);  // whatever the umask
    return made;
  }

  void release() {
    for (const int fd : locks_) {
      close(fd);
    }
    locks_.clear();
  }

  int first_{};
  std::vector<int> locks_;
};

}  // namespace hlc::test
