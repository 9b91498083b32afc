#include "hlc_bridge/record/configuration.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "hlc_bridge/record/text_file.hpp"
#include "tests/support/temporary_folder.hpp"

namespace hlc {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(Configuration, KeepsCopiesWhosePathsToEachOtherStayGood) {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder / "scenarios");
  std::filesystem::create_directories(folder / "maps");
  std::filesystem::create_directories(folder / "run");
  put(folder / "scenarios" / "s.yaml", "map: ../maps/m.xml");
  put(folder / "maps" / "m.xml", "<map/>");
  const std::filesystem::path configuration = folder / "run" / "configuration";
  keep_configuration(folder / "run", {folder / "scenarios" / "s.yaml",
                                      folder / "scenarios" / ".." / "maps" / "m.xml"});
  EXPECT_EQ(read_file(configuration / "scenarios" / "s.yaml"), "map: ../maps/m.xml");
  EXPECT_EQ(read_file(configuration / "scenarios" / ".." / "maps" / "m.xml"), "<map/>");
}

TEST(Configuration, MissingFileIsNamed) {
  const TemporaryFolder folder;
  EXPECT_THAT([&] { keep_configuration(folder.path(), {folder / "nothing.yaml"}); },
              ThrowsMessage<std::runtime_error>(HasSubstr("nothing.yaml: cannot be read")));
}

}  // namespace
}  // namespace hlc
