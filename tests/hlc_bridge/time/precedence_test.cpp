#include "hlc_bridge/time/precedence.hpp"

#include <gtest/gtest.h>
#include <sched.h>

#include <thread>

namespace hlc {
namespace {

int policy() { return sched_getscheduler(0) & ~SCHED_RESET_ON_FORK; }

TEST(Precedence, IsOfOneThreadAloneAndOnlyWhereItIsAllowed) {
  const int before = policy();
  int within = -1;
  int inherited = -1;
  bool allowed = false;
  std::thread([&] {
    allowed = take_precedence();
    within = policy();
    std::thread([&] { inherited = policy(); }).join();
  }).join();
  EXPECT_EQ(within, allowed ? SCHED_FIFO : before);
  EXPECT_EQ(inherited, SCHED_OTHER);
  EXPECT_EQ(policy(), before);
}

}  // namespace
}  // namespace hlc
