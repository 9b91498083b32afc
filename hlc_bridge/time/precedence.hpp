#pragma once

namespace hlc::time {

inline constexpr int kMaxThreadPriority = 99;

/// Gives the calling thread precedence over everything on the computer that is not real-time or has
/// a lower priority (SCHED_FIFO), so that no other thread preempts a plan. Threads that it starts
/// are ordinary ones. For a thread that waits most of the time.
///
/// @pre 1 <= priority <= kMaxThreadPriority
/// @return false if the system does not permit it, with nothing changed: it takes the capability
/// CAP_SYS_NICE (root has it) or an rtprio limit of at least `priority` (`ulimit -r`)
bool take_precedence(int priority);

inline constexpr int kMaxCore = 1023;  ///< the highest number that a set of cores can hold

/// Pins the calling thread, and those that it starts from now on, to one core.
///
/// @return false if this process has no such core, with nothing changed
bool stay_on_core(int core);

/// Lets the calling thread yield to ordinary ones on the same core: for background work of the
/// control loop without a deadline. Threads that it starts inherit this.
void give_precedence();

}  // namespace hlc::time
