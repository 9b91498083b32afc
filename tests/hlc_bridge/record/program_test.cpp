#include "hlc_bridge/record/program.hpp"

#include <gtest/gtest.h>

namespace hlc::record {
namespace {

TEST(Program, TellsRevisionAndHost) {
  EXPECT_FALSE(program_revision().empty());
  EXPECT_FALSE(this_host().cpu.empty());
  EXPECT_GE(this_host().cores, 1U);
  EXPECT_EQ(this_host().kernel.rfind("Linux ", 0), 0U);
}

}  // namespace
}  // namespace hlc::record
