#include "planner/common/csv.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "tests/support/temporary_folder.hpp"

namespace hlc {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(CsvLine, WritesNumbersTruthsTextsAndWhatIsNotThere) {
  CsvLine line(1U, 0.1, true, "a", std::string("b,c"));
  line.add(std::optional<double>(), std::optional(-2.5));
  EXPECT_EQ(line.text(), "1,0.1,1,a,\"b,c\",,-2.5\n");
  EXPECT_EQ(CsvLine("", "").text(), ",\n");
}

class CsvTableTest : public testing::Test {
 protected:
  CsvTable table(const std::string& content) {
    test::put(folder_ / "t.csv", content);
    return {folder_ / "t.csv", "a,b"};
  }
  test::TemporaryFolder folder_;
};

TEST_F(CsvTableTest, GivesTheFieldsOfItsRows) {
  const CsvTable csv = table("a,b\n1.5,7\n-2,0\n");
  ASSERT_EQ(csv.size(), 2U);
  EXPECT_EQ(csv.number(0, 0), 1.5);
  EXPECT_EQ(csv.unsigned_number(0, 1), 7U);
  EXPECT_EQ(csv.number(1, 0), -2.0);
}

TEST_F(CsvTableTest, IncompleteLastLineIsLeftOut) {
  EXPECT_EQ(table("a,b\n1,2\n3,").size(), 1U);
  EXPECT_EQ(table("a,b\n1,2\n3,4").size(), 1U);
}

TEST_F(CsvTableTest, FieldsInQuotesMayHoldAnything) {
  for (const std::string& text :
       {std::string{}, std::string{","}, std::string{"\n"}, std::string{"\""}, std::string{"\"\""},
        std::string{"a, \"b\"\r\nc"}}) {
    const CsvTable csv = table("a,b\n" + csv_field(text) + "," + csv_field(text) + "\n1,2\n");
    ASSERT_EQ(csv.size(), 2U) << text;
    EXPECT_EQ(csv.text(0, 0), text);
    EXPECT_EQ(csv.text(0, 1), text);
    EXPECT_EQ(csv.text(1, 1), "2") << text;
  }
  EXPECT_EQ(csv_field("J2 of B"), "J2 of B");
}

TEST_F(CsvTableTest, IncompleteLastLineIsLeftOutWithinQuotesToo) {
  const std::string row = "1,\"a, \"\"b\"\" c\"";
  for (std::size_t length = 0; length <= row.size(); ++length) {
    EXPECT_EQ(table("a,b\n1,2\n" + row.substr(0, length)).size(), 1U) << length;
  }
  EXPECT_EQ(table("a,b\n1,2\n" + row + "\n").text(1, 1), "a, \"b\" c");
}

TEST_F(CsvTableTest, RefusesQuotesThatDoNotBelongThere) {
  EXPECT_THAT([&] { table("a,b\n1,2\n3,4\"\n"); },
              ThrowsMessage<std::runtime_error>(HasSubstr("t.csv:3: a quote within a field")));
  EXPECT_THAT([&] { table("a,b\n\"1\"x,2\n"); },
              ThrowsMessage<std::runtime_error>(HasSubstr("t.csv:2: more behind a closing quote")));
  EXPECT_THAT([&] { table("a,b\n1,\"2\n3,4\n5,6\n"); },
              ThrowsMessage<std::runtime_error>(HasSubstr("t.csv:2: a quote that is not closed")));
}

TEST_F(CsvTableTest, CountsLinesWithinQuotes) {
  const CsvTable csv = table("a,b\n\"1\n1\",2\nx,3\n");
  EXPECT_THAT([&] { (void)csv.number(1, 0); },
              ThrowsMessage<std::runtime_error>(HasSubstr("t.csv:4: a = \"x\"")));
}

TEST_F(CsvTableTest, RefusesAnotherHeadingAndMissingFields) {
  EXPECT_THAT([&] { table("a,c\n"); },
              ThrowsMessage<std::runtime_error>(HasSubstr("t.csv:1: the heading must be a,b")));
  EXPECT_THAT([&] { table(""); }, ThrowsMessage<std::runtime_error>(HasSubstr("t.csv:1")));
  EXPECT_THAT([&] { table("a,b\n1,2\n3\n"); },
              ThrowsMessage<std::runtime_error>(HasSubstr("t.csv:3: 1 fields, must be 2")));
}

TEST_F(CsvTableTest, RefusesWhatIsNoNumberAndNamesThePlace) {
  const CsvTable csv = table("a,b\n1,2\n1x,-3\n,4\n");
  EXPECT_THAT(
      [&] { (void)csv.number(1, 0); },
      ThrowsMessage<std::runtime_error>(HasSubstr("t.csv:3: a = \"1x\", must be a number")));
  EXPECT_THAT([&] { (void)csv.unsigned_number(1, 1); },
              ThrowsMessage<std::runtime_error>(HasSubstr("b = \"-3\", must be a whole number")));
  EXPECT_THROW((void)csv.number(2, 0), std::runtime_error);
}

TEST_F(CsvTableTest, ColumnsOfAFileOfAnybodyMayHoldCommasWithinQuotes) {
  test::put(folder_ / "t.csv", "run,\"share.J2, at most 0.6 m/s\"\n1,0.5\n");
  const CsvTable csv(folder_ / "t.csv");
  EXPECT_EQ(csv.columns(), (std::vector<std::string>{"run", "share.J2, at most 0.6 m/s"}));
  EXPECT_EQ(csv.number(0, 1), 0.5);
}

TEST_F(CsvTableTest, AFileOfAnybodyMayHaveAnyColumnsAndLineEnds) {
  test::put(folder_ / "t.csv", "x,y\r\n1,2\r\n3,4");
  const CsvTable csv(folder_ / "t.csv");
  EXPECT_EQ(csv.size(), 2U);
  EXPECT_EQ(csv.find("y"), 1U);
  EXPECT_EQ(csv.find("z"), std::nullopt);
  EXPECT_EQ(csv.number(1, 1), 4.0);
  EXPECT_THAT(
      [&] { (void)CsvTable("/dev/zero"); },
      ThrowsMessage<std::invalid_argument>("/dev/zero: cannot be read, must be a CSV file"));
}

}  // namespace
}  // namespace hlc
