#include "planner/apps/fitted_table.hpp"

#include <gtest/gtest.h>

#include <random>
#include <sstream>
#include <string>

namespace hlc::apps {
namespace {

const std::string kTable =
    "id  name   error  lap\n"
    " 1  rød      1.5   12\n"
    " 2  blue    11.5    -\n";

TEST(FittedTable, IsUnchangedWhereItFits) {
  EXPECT_EQ(fitted_table(kTable, 21), kTable);
  EXPECT_EQ(fitted_table("a\n\n  b  c\n", 40), "a\n\n  b  c\n");
}

TEST(FittedTable, ThatIsTooWideIsCutBetweenColumnsAndBeginsAgainWithTheFirst) {
  EXPECT_EQ(fitted_table(kTable, 18),
            "id  name   error\n"
            " 1  rød      1.5\n"
            " 2  blue    11.5\n"
            "\n"
            "id lap\n"
            " 1  12\n"
            " 2   -\n");
}

TEST(FittedTable, ALineOfWordsGoesOnInTheNext) {
  EXPECT_EQ(fitted_table("  wall time     0.42 s and more\n", 20),
            "  wall time     0.42\n      s and more\n");
  EXPECT_EQ(fitted_table("one " + std::string(30, 'x') + " two\n", 20),
            "one\n    " + std::string(30, 'x') + "\n    two\n");
}

TEST(FittedLines, GoOnInTheNextEvenIfTheirBlanksMeet) {
  const std::string lines = "alone     the same\nwithout 2 a turn\n";
  EXPECT_EQ(fitted_lines(lines, 18), lines);
  EXPECT_EQ(fitted_lines(lines, 14), "alone     the\n    same\nwithout 2 a\n    turn\n");
  EXPECT_EQ(fitted_lines("a\n\nb", 14), "a\n\nb\n");
}

TEST(FittedTable, LosesNothingAndIsNoWiderWhateverTheWidth) {
  std::mt19937 random(1);
  for (std::size_t columns = 20; columns < 60; ++columns) {
    std::string text;
    for (int word = 100; word < 172; ++word) {
      std::string cell = std::string(random() % 3, ' ') + std::to_string(word);
      if (columns % 2 == 0) cell.resize(5, ' ');  // a table
      text += cell + ((word + 1) % 12 == 4 ? "\n" : " ");
    }
    const std::string fitted = fitted_table(text, columns);
    std::istringstream lines(fitted);
    for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), columns) << fitted;
    std::istringstream words(text);
    for (std::string word; words >> word;) {
      EXPECT_NE(fitted.find(word), std::string::npos) << word << '\n' << text << '\n' << fitted;
    }
  }
}

}  // namespace
}  // namespace hlc::apps
