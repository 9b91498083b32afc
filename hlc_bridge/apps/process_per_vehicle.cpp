#include "hlc_bridge/apps/process_per_vehicle.hpp"

#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <system_error>

#include "hlc_bridge/messages/exit_codes.hpp"

namespace hlc::apps {
namespace {

pid_t start(int id, pid_t parent, const RunOne& run) {
  const pid_t pid = fork();
  if (pid != 0) return pid;
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (getppid() != parent) _exit(kExitDied);  // the parent ended before prctl took effect
  int code = kExitDied;
  {
    time::StopSignals signals;  // the parent's are shared with all children
    code = run(id, signals);
  }  // with it the process's participants end: the library's own destructors would be too late
  std::exit(code);
}

/// Waits for the process's end and leaves it a zombie, so that its pid is not reused while a signal
/// may still be sent to it.
int exit_code_of(pid_t pid) {
  siginfo_t info{};
  while (waitid(P_PID, static_cast<id_t>(pid), &info, WEXITED | WNOWAIT) < 0) {
    if (errno != EINTR) return kExitDied;
  }
  return info.si_code == CLD_EXITED ? info.si_status : kExitDied;
}

}  // namespace

int process_per_vehicle(const std::vector<int>& ids, time::StopSignals& signals,
                        const RunOne& run) {
  if (ids.size() == 1) return run(ids.front(), signals);
  const pid_t parent = getpid();
  std::vector<pid_t> children;
  for (const int id : ids) {
    const pid_t pid = start(id, parent, run);
    if (pid < 0) {
      const int error = errno;
      for (const pid_t child : children) kill(child, SIGTERM);
      for (const pid_t child : children) static_cast<void>(exit_code_of(child));
      throw std::system_error(error, std::generic_category(), "fork");
    }
    children.push_back(pid);
  }
  signals.on_stop([children](int signal) {
    for (const pid_t child : children) kill(child, signal);
  });
  int code = kExitGood;
  for (const pid_t child : children) code = std::max(code, exit_code_of(child));
  return code;
}

}  // namespace hlc::apps
