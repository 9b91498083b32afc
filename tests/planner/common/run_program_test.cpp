#include "planner/common/run_program.hpp"

#include <gtest/gtest.h>

namespace hlc::run_program_test {
namespace {

TEST(RunProgram, IsTrueOnlyOfAProgramThatEndsWell) {
  EXPECT_TRUE(run_program({"/bin/sh", "-c", "test \"$1\" = 'a b'", "sh", "a b"}));
  EXPECT_FALSE(run_program({"/bin/sh", "-c", "exit 3"}));
  EXPECT_FALSE(run_program({"/bin/sh", "-c", "kill -9 $$"}));
  testing::internal::CaptureStderr();
  EXPECT_FALSE(run_program({"/nowhere/program"}));
  EXPECT_EQ(testing::internal::GetCapturedStderr(),
            "/nowhere/program: cannot be started, must be a program\n");
}

}  // namespace
}  // namespace hlc::run_program_test
