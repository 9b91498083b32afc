#pragma once

#include <sched.h>
#include <sys/mount.h>

namespace hlc::test {

/// Gives this process and those that it starts from now on an empty /dev/shm of their own: what is
/// left in it is theirs, and is gone with them. Before the first thread; once, however often it is
/// asked for. False without root: they share the machine's.
inline bool use_own_shared_memory() {
  static const bool is_own = ::unshare(CLONE_NEWNS) == 0 &&
                             ::mount(nullptr, "/", nullptr, MS_REC | MS_PRIVATE, nullptr) == 0 &&
                             ::mount("tmpfs", "/dev/shm", "tmpfs", 0, nullptr) == 0;
  return is_own;
}

}  // namespace hlc::test
