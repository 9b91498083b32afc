#include "hlc_bridge/apps/log_flag.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "tests/support/program.hpp"

namespace hlc::apps {
namespace {

spdlog::sinks::stdout_color_sink_mt& default_sink() {
  return dynamic_cast<spdlog::sinks::stdout_color_sink_mt&>(
      *spdlog::default_logger()->sinks().front());
}

TEST(Log, HasNoColoursIfNobodyWantsThem) {
  for (const auto& [no_color, has_colours] : {std::pair{"", true}, {"1", false}}) {
    default_sink().set_color_mode(spdlog::color_mode::always);  // as on a terminal
    ::setenv("NO_COLOR", no_color, 1);
    set_up_log("info");
    EXPECT_EQ(default_sink().should_color(), has_colours) << no_color;
  }
  ::unsetenv("NO_COLOR");
  default_sink().set_color_mode(spdlog::color_mode::automatic);
}

TEST(Log, LevelIsThatOfTheFlag) {
  set_up_log("warning");
  EXPECT_FALSE(spdlog::should_log(spdlog::level::info));
  EXPECT_TRUE(spdlog::should_log(spdlog::level::warn));
  set_up_log("off");
  EXPECT_FALSE(spdlog::should_log(spdlog::level::critical));
  set_up_log("info");
}

// On the lab's transport they warn of flags that they do not know.
TEST(Log, LevelIsAlsoThatOfTheVariable) {
  const std::string command = "middleware --vehicle_ids 1 --unknown 3 --offset_nanoseconds x";
  const test::Outcome refused = test::run_program(command + " --log_level loud");
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.output.find("must be one of trace, debug, info"), std::string::npos);
  const test::Outcome of_variable = test::run_program(command, "HLC_LOG_LEVEL=loud ");
  EXPECT_EQ(of_variable.exit_code, 2);
  EXPECT_NE(of_variable.output.find("loud, must be one of"), std::string::npos)
      << of_variable.output;
}

}  // namespace
}  // namespace hlc::apps
