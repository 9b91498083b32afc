// search_benchmark as it is called.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/program.hpp"

namespace hlc::test::search_benchmark_program_test {
namespace {

using testing::HasSubstr;

TEST(SearchBenchmark, ASetIsMeasuredOnceAndColumnsAreExplained) {
  const Outcome outcome = run_program("search_benchmark --sets three_cars --problems 1");
  EXPECT_EQ(outcome.exit_code, 0);
  for (const char* text : {"\nx mean, x p99, x max: ", "\nns/vertex: ", "\noptimal: "}) {
    EXPECT_THAT(outcome.output, HasSubstr(text));
  }
}

TEST(SearchBenchmark, BadSetsAreRefusedInOneLine) {
  struct Case {
    const char* flags;
    const char* message;
  };
  for (const auto& [flags, message] :
       {Case{"--sets three_cars,three_cars", "--sets = three_cars twice, must be unique"},
        Case{"--sets three_cars,four_cars",
             "--sets: four_cars, must be one of three_cars, three_cars_corr"},
        Case{"--sets=", "--sets: "}, Case{"--sets ''", ", must be "},
        Case{"--only fast", "--only: fast, must be one of plain, "}}) {
    const Outcome outcome = run_program(std::string("search_benchmark --problems 1 ") + flags);
    EXPECT_EQ(outcome.exit_code, 2) << flags;
    EXPECT_THAT(outcome.output, HasSubstr(message));
    EXPECT_THAT(outcome.output, HasSubstr(", must be "));
    EXPECT_EQ(std::ranges::count(outcome.output, '\n'), 1) << outcome.output;
  }
}

}  // namespace
}  // namespace hlc::test::search_benchmark_program_test
