#include "hlc_bridge/render/base64.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace hlc::render {
namespace {

// The examples of RFC 4648, section 10.
TEST(Base64, TheExamplesOfTheStandardAreRead) {
  EXPECT_EQ(bytes_of_base64(""), "");
  EXPECT_EQ(bytes_of_base64("Zg=="), "f");
  EXPECT_EQ(bytes_of_base64("Zm8="), "fo");
  EXPECT_EQ(bytes_of_base64("Zm9v"), "foo");
  EXPECT_EQ(bytes_of_base64("Zm9vYg=="), "foob");
  EXPECT_EQ(bytes_of_base64("Zm9vYmFy"), "foobar");
}

TEST(Base64, BytesBeyondAsciiAreRead) {
  EXPECT_EQ(bytes_of_base64("+/8A"), std::string("\xfb\xff\0", 3));
}

TEST(Base64, OtherCharactersAreRefused) {
  EXPECT_THROW(static_cast<void>(bytes_of_base64("Zm 9v")), std::invalid_argument);
}

}  // namespace
}  // namespace hlc::render
