#include "planner/common/yaml_text.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <random>

#include "planner/common/node.hpp"

namespace hlc {
namespace {

TEST(ShortestText, ReadsBackAsTheSameBits) {
  std::mt19937_64 random{17};
  for (int i = 0; i < 10'000; ++i) {
    const auto value = std::bit_cast<double>(random());
    if (!std::isfinite(value)) {
      continue;
    }
    const std::string text = shortest_text(value);
    double back{};
    std::from_chars(text.data(), text.data() + text.size(), back);
    ASSERT_EQ(std::bit_cast<std::uint64_t>(back), std::bit_cast<std::uint64_t>(value)) << text;
  }
  EXPECT_EQ(shortest_text(0.1), "0.1");
  EXPECT_EQ(shortest_text(-0.0), "-0");
}

TEST(QuotedYaml, ReadsBack) {
  for (const char* text : {"", "B", "a: b # c", "\"\\\"", "- [x]", "µCar"}) {
    const Node node = Node::parse_yaml("key: " + quoted_yaml(text), "test");
    EXPECT_EQ(node.required<std::string>("key"), text);
  }
}

TEST(OneLine, IsOneShortLine) {
  EXPECT_EQ(one_line("0.22 µm"), "0.22 µm");
  EXPECT_EQ(one_line("a\nb\tc"), "a\\nb\\x09c");
  EXPECT_EQ(one_line(std::string(60, 'x')), std::string(60, 'x'));
  EXPECT_EQ(one_line(std::string(61, 'x')), std::string(60, 'x') + "...");
  EXPECT_EQ(one_line(std::string(59, 'x') + "µm"), std::string(59, 'x') + "µ...");
  EXPECT_EQ(one_line("abcd", 3), "abc...");
  EXPECT_EQ(escaped(std::string(80, 'x') + "\x1b"), std::string(80, 'x') + "\\x1b");
}

}  // namespace
}  // namespace hlc
