#include "planner/common/xml_text.hpp"

#include <gtest/gtest.h>

namespace hlc {
namespace {

TEST(XmlText, EscapesWhatMeansSomethingInXml) {
  EXPECT_EQ(xml_escaped("a < b & \"c\" > d"), "a &lt; b &amp; &quot;c&quot; &gt; d");
  EXPECT_EQ(xml_escaped("\xc2\xb5"
                        "Car 1:18"),
            "\xc2\xb5"
            "Car 1:18");
}

}  // namespace
}  // namespace hlc
