#include "hlc_bridge/time/stop_signals.hpp"

#include <poll.h>
#include <pthread.h>
#include <signal.h>
#include <sys/eventfd.h>
#include <sys/signalfd.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <system_error>
#include <utility>

namespace hlc::time {
namespace {

sigset_t stop_signals() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGINT);
  sigaddset(&signals, SIGTERM);
  return signals;
}

void check(int result, const char* what) {
  if (result < 0) {
    throw std::system_error(errno, std::generic_category(), what);
  }
}

// The first of the signals; 0 if `end_fd` becomes readable before.
int wait_for_signal(int signal_fd, int end_fd) {
  std::array<pollfd, 2> files{pollfd{signal_fd, POLLIN, 0}, pollfd{end_fd, POLLIN, 0}};
  while (poll(files.data(), files.size(), -1) < 0 && errno == EINTR) {
  }
  signalfd_siginfo info{};
  if ((files[1].revents & POLLIN) != 0 || read(signal_fd, &info, sizeof info) != sizeof info) {
    return 0;
  }
  return static_cast<int>(info.ssi_signo);
}

}  // namespace

StopSignals::StopSignals() : end_fd_{eventfd(0, EFD_CLOEXEC)} {
  check(end_fd_, "eventfd");
  ::signal(SIGXFSZ, SIG_IGN);  // exceeding the file size limit is then a write error like others
  const sigset_t signals = stop_signals();
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
}

StopSignals::~StopSignals() {
  if (thread_.joinable()) {
    const std::uint64_t end = 1;
    [[maybe_unused]] const ssize_t written = write(end_fd_, &end, sizeof end);
    thread_.join();
  }
  close(end_fd_);
}

void StopSignals::on_stop(std::function<void(int)> callback) {
  const sigset_t signals = stop_signals();
  const int signal_fd = signalfd(-1, &signals, SFD_CLOEXEC);
  check(signal_fd, "signalfd");
  thread_ = std::thread{[signal_fd, end_fd = end_fd_, callback = std::move(callback)] {
    const int signal = wait_for_signal(signal_fd, end_fd);
    close(signal_fd);
    if (signal != 0) {
      callback(signal);
    }
  }};
}

}  // namespace hlc::time
