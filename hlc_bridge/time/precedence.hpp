#pragma once

namespace hlc {

/// Lets the calling thread run before everything on the computer that is not real-time
/// (SCHED_FIFO, lowest priority), so that no other thread takes its core in the middle of a plan.
/// Threads that it starts are ordinary ones. For a thread that waits most of the time.
///
/// @return false if the system does not allow it, and nothing has changed: it takes the capability
/// CAP_SYS_NICE (root has it) or an rtprio limit of at least 1 (`ulimit -r`)
bool take_precedence();

}  // namespace hlc
