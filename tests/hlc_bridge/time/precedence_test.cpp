#include "hlc_bridge/time/precedence.hpp"

#include <gtest/gtest.h>
#include <sched.h>
#include <sys/resource.h>

#include <thread>

namespace hlc::time {
namespace {

int policy() { return sched_getscheduler(0) & ~SCHED_RESET_ON_FORK; }

TEST(Precedence, IsOfOneThreadAloneAndOnlyWhereItIsAllowed) {
  const int before = policy();
  int within = -1;
  int inherited = -1;
  bool allowed = false;
  std::thread([&] {
    allowed = take_precedence(1);
    within = policy();
    std::thread([&] { inherited = policy(); }).join();
  }).join();
  EXPECT_EQ(within, allowed ? SCHED_FIFO : before);
  EXPECT_EQ(inherited, SCHED_OTHER);
  EXPECT_EQ(policy(), before);
}

TEST(Precedence, AThreadStaysOnTheCoreThatItIsGiven) {
  std::thread([] {
    cpu_set_t allowed;
    ASSERT_EQ(sched_getaffinity(0, sizeof allowed, &allowed), 0);
    int core = 0;
    while (CPU_ISSET(static_cast<unsigned>(core), &allowed) == 0) ++core;
    EXPECT_TRUE(stay_on_core(core));
    EXPECT_EQ(sched_getcpu(), core);
    EXPECT_FALSE(stay_on_core(-1));
    EXPECT_FALSE(stay_on_core(CPU_SETSIZE));
    EXPECT_EQ(sched_getcpu(), core);
  }).join();
}

int niceness() { return getpriority(PRIO_PROCESS, 0); }

TEST(Precedence, IsGivenByOneThreadAlone) {
  const int before = niceness();
  int within = before;
  std::thread([&] {
    give_precedence();
    within = niceness();
  }).join();
  EXPECT_GT(within, before);
  EXPECT_EQ(niceness(), before);
}

}  // namespace
}  // namespace hlc::time
