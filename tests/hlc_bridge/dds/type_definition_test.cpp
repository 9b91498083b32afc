#include "hlc_bridge/dds/type_definition.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>
#include <set>

#include "hlc_bridge/dds/wire.hpp"
#include "tests/hlc_bridge/dds/sample_messages.hpp"

namespace hlc::dds::type_definition_test {
namespace {

template <class Message>
class TypeDefinition : public testing::Test {};
TYPED_TEST_SUITE(TypeDefinition, AllMessages);

TYPED_TEST(TypeDefinition, DefinesTheTypeAndAllThatItUsesEachOnceAndBefore) {
  const std::string type = type_support<TypeParam>(Transport::kLab).get_type_name();
  const std::string text = type_definition(type);
  EXPECT_THAT(text, testing::Not(testing::HasSubstr("#")));
  std::set<std::string> defined{"octet", "boolean", "double", "string",
                                "short", "long",    "float",  "unsigned"};
  std::istringstream lines(text);
  std::smatch match;
  const std::regex type_begins("(struct|enum) (\\w+) \\{");
  const std::regex member("^ *(@key )?(sequence<)?(\\w+)[\\w ]*>? \\w+; *(//.*)?$");
  std::size_t members = 0;
  for (std::string line; std::getline(lines, line);) {
    if (std::regex_match(line, match, type_begins)) {
      EXPECT_TRUE(defined.insert(match[2]).second) << line;
    } else if (std::regex_match(line, match, member)) {
      EXPECT_TRUE(defined.contains(match[3])) << line;
      ++members;
    }
  }
  EXPECT_TRUE(defined.contains(type.substr(type.rfind(':') + 1))) << type;
  EXPECT_GT(members, 0U);
}

}  // namespace
}  // namespace hlc::dds::type_definition_test
