#include "hlc_bridge/time/precedence.hpp"

#include <sched.h>
#include <unistd.h>

namespace hlc::time {
namespace {

constexpr pid_t kThisThread = 0;
/// A third of an ordinary thread's share: the control loop wakes up at once, and on an idle core
/// nothing is lost. Less would make a step of logical time, which waits for this thread, slow on a
/// busy computer.
constexpr int kNicer = 5;

}  // namespace

bool take_precedence(int priority) {
  sched_param parameters{};
  parameters.sched_priority = priority;
  return sched_setscheduler(kThisThread, SCHED_FIFO | SCHED_RESET_ON_FORK, &parameters) == 0;
}

bool stay_on_core(int core) {
  static_assert(kMaxCore == CPU_SETSIZE - 1);
  if (core < 0 || core > kMaxCore) return false;
  cpu_set_t cores;
  CPU_ZERO(&cores);
  CPU_SET(static_cast<unsigned>(core), &cores);
  return sched_setaffinity(kThisThread, sizeof cores, &cores) == 0;
}

void give_precedence() {
  static_cast<void>(nice(kNicer));  // on Linux it affects the calling thread only
}

}  // namespace hlc::time
