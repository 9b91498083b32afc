#include "planner/apps/terminal.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cstdlib>

namespace hlc::apps {
namespace {

TEST(Wrapped, BreaksAtBlanksAndIndentsEveryLine) {
  EXPECT_EQ(wrapped("one two three", 9, 2), "  one two\n  three\n");
  EXPECT_EQ(wrapped("one\ntwo three", 20, 0), "one\ntwo three\n");
  EXPECT_EQ(wrapped("a wordthatistoolong b", 6, 0), "a\nwordthatistoolong\nb\n");
  EXPECT_EQ(wrapped("", 20, 2), "");
}

TEST(Wrapped, CountsCharactersInsteadOfBytes) {
  EXPECT_EQ(wrapped("\u00b5\u00b5\u00b5 \u00b5\u00b5", 6, 0), "\u00b5\u00b5\u00b5 \u00b5\u00b5\n");
}

TEST(Wrapped, LeavesCommandsWhole) {
  EXPECT_EQ(wrapped("Examples:\n  rollout --scenario circle", 12, 0),
            "Examples:\n  rollout --scenario circle\n");
}

TEST(Columns, OfAPipeAreThoseOfTheVariable) {
  std::array<int, 2> ends{};
  ASSERT_EQ(::pipe(ends.data()), 0);
  ::unsetenv("COLUMNS");
  EXPECT_EQ(columns_of(ends[1]), kPlainColumns);
  for (const auto& [text, columns] : {std::pair{"72", 72U}, {"3", 40U}, {"wide", 100U}}) {
    ::setenv("COLUMNS", text, 1);
    EXPECT_EQ(columns_of(ends[1]), columns) << text;
  }
  ::unsetenv("COLUMNS");
  for (const int end : ends) ::close(end);
}

}  // namespace
}  // namespace hlc::apps
