#pragma once

namespace hlc {

inline constexpr int kMaxThreadPriority = 99;

/// Lets the calling thread run before everything on the computer that is not real-time or has a
/// lower priority (SCHED_FIFO), so that no other thread takes its core in the middle of a plan.
/// Threads that it starts are ordinary ones. For a thread that waits most of the time.
///
/// @pre 1 <= priority <= kMaxThreadPriority
/// @return false if the system does not allow it, and nothing has changed: it takes the capability
/// CAP_SYS_NICE (root has it) or an rtprio limit of at least `priority` (`ulimit -r`)
bool take_precedence(int priority);

inline constexpr int kMaxCore = 1023;  ///< the highest number that a set of cores can hold

/// Keeps the calling thread, and those that it starts from now on, on one core.
///
/// @return false if there is no such core for this process, and nothing has changed
bool stay_on_core(int core);

/// Lets the calling thread run after ordinary ones where they want the same core: for work beside
/// the control loop that may take its time. Threads that it starts do so, too.
void give_precedence();

}  // namespace hlc
