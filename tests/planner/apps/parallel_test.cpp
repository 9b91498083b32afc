#include "planner/apps/parallel.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

namespace hlc::apps {
namespace {

TEST(Parallel, EveryTaskIsDoneOnceWhateverTheNumberOfJobs) {
  for (const std::size_t jobs : {1U, 2U, 7U}) {
    std::vector<int> times(100);
    std::size_t last = 0;
    run_parallel(
        times.size(), jobs, [&](std::size_t i) { ++times[i]; },
        [&](std::size_t done) { EXPECT_EQ(done, ++last); });
    EXPECT_EQ(times, std::vector<int>(100, 1));
    EXPECT_EQ(last, 100U);
  }
  run_parallel(
      0, 3, [](std::size_t) { FAIL(); }, [](std::size_t) { FAIL(); });
}

TEST(Parallel, TheFirstErrorIsThrownAndNothingNewBegun) {
  for (const std::size_t jobs : {1U, 3U}) {
    std::atomic<std::size_t> begun{0};
    try {
      run_parallel(
          1000, jobs,
          [&](std::size_t i) {
            ++begun;
            if (i >= 10) throw std::runtime_error("task " + std::to_string(i));
          },
          [](std::size_t) {});
      FAIL();
    } catch (const std::runtime_error& error) {
      EXPECT_EQ(std::string(error.what()), "task 10");
    }
    EXPECT_LE(begun, 10 + jobs + 1);
  }
}

}  // namespace
}  // namespace hlc::apps
