#include "hlc_bridge/time/precedence.hpp"

#include <sched.h>

namespace hlc {

bool take_precedence() {
  constexpr pid_t kThisThread = 0;
  sched_param parameters{};
  parameters.sched_priority = sched_get_priority_min(SCHED_FIFO);
  return sched_setscheduler(kThisThread, SCHED_FIFO | SCHED_RESET_ON_FORK, &parameters) == 0;
}

}  // namespace hlc
