#include "planner/common/growing_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <system_error>
#include <utility>
#include <vector>

#include "planner/common/text_file.hpp"
#include "tests/support/full_disk.hpp"
#include "tests/support/temporary_folder.hpp"

namespace hlc {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

using Opening = GrowingFile::Opening;

class GrowingFileTest : public testing::Test {
 protected:
  GrowingFile open(const std::filesystem::path& file, Opening opening = Opening::kEmptied) {
    return {file, opening, [this](const std::string& line) { failures_.push_back(line); }};
  }

  const test::TemporaryFolder folder_;
  std::vector<std::string> failures_;
};

TEST_F(GrowingFileTest, EveryRowIsInTheFileAtOnce) {
  GrowingFile file = open(folder_ / "rows.csv");
  file.begin("a,b\n");
  file.write("1,2\n");
  EXPECT_EQ(read_file(folder_ / "rows.csv"), "a,b\n1,2\n");
  EXPECT_EQ(file.close(), std::nullopt);
  GrowingFile continued = open(folder_ / "rows.csv", Opening::kContinued);
  continued.write("3,4\n");
  EXPECT_EQ(read_file(folder_ / "rows.csv"), "a,b\n1,2\n3,4\n");
  EXPECT_THAT(failures_, IsEmpty());
}

TEST_F(GrowingFileTest, AFullDiskIsReportedOnceAndTheRowsAreCounted) {
  GrowingFile file = open("/dev/full");
  for (int row = 0; row < 3; ++row) file.write("1,2\n");
  EXPECT_THAT(failures_, ElementsAre("/dev/full: no longer written: No space left on device"));
  EXPECT_EQ(file.close(), "/dev/full: incomplete, 3 rows are missing");
  EXPECT_EQ(file.close(), "/dev/full: incomplete, 3 rows are missing");
  EXPECT_THAT(failures_, testing::SizeIs(1));
}

TEST_F(GrowingFileTest, NothingFollowsAnIncompleteRow) {
  GrowingFile file = open(folder_ / "rows.csv");
  {
    const test::FullDisk disk(6);
    file.write("1,2\n");
    file.write("3,4\n");
  }
  file.write("5,6\n");
  EXPECT_EQ(read_file(folder_ / "rows.csv"), "1,2\n3,");
  EXPECT_THAT(file.close(), testing::Optional(HasSubstr("2 rows are missing")));
}

TEST_F(GrowingFileTest, AFolderThatIsRemovedMeanwhileIsReported) {
  std::filesystem::create_directory(folder_ / "run");
  GrowingFile file = open(folder_ / "run" / "rows.csv");
  file.write("1,2\n");
  std::filesystem::remove_all(folder_ / "run");
  file.write("3,4\n");
  EXPECT_THAT(failures_, ElementsAre(HasSubstr("rows.csv: no longer written: No such file")));
}

TEST_F(GrowingFileTest, AFileThatIsRemovedAfterTheLastRowIsIncomplete) {
  GrowingFile file = open(folder_ / "rows.csv");
  file.write("1,2\n");
  std::filesystem::remove(folder_ / "rows.csv");
  EXPECT_NE(file.close(), std::nullopt);
  EXPECT_THAT(failures_, ElementsAre(HasSubstr("rows.csv: no longer written: No such file")));
}

TEST_F(GrowingFileTest, AWholeFileInItsPlaceIsComplete) {
  GrowingFile file = open(folder_ / "rows.csv");
  {
    const test::FullDisk disk(2);
    file.write("3,4\n");
  }
  file.replace("1,2\n3,4\n");
  EXPECT_EQ(read_file(folder_ / "rows.csv"), "1,2\n3,4\n");
  EXPECT_EQ(file.close(), std::nullopt);
}

TEST_F(GrowingFileTest, AWholeFileThatCannotBeWrittenIsReported) {
  GrowingFile file = open(folder_ / "rows.csv");
  file.write("3,4\n");
  {
    const test::FullDisk disk(6);
    file.replace("1,2\n3,4\n");
  }
  const std::string name = (folder_ / "rows.csv").string();
  EXPECT_THAT(failures_, ElementsAre(name + ": cannot be written: File too large"));
  EXPECT_EQ(file.close(), name + ": incomplete");
  EXPECT_EQ(read_file(folder_ / "rows.csv"), "3,4\n");
}

TEST_F(GrowingFileTest, AtTheBeginWhatCannotBeWrittenIsAnException) {
  const auto create = [this](const std::filesystem::path& file) {
    return [this, file] { open(file).begin("a,b\n"); };
  };
  EXPECT_THAT(create("/dev/full"), testing::ThrowsMessage<std::system_error>(
                                       "/dev/full: cannot be written: No space left on device"));
  EXPECT_THAT(
      create(folder_ / "no" / "rows.csv"),
      testing::ThrowsMessage<std::system_error>(HasSubstr("no/rows.csv: cannot be written: No")));
  test::put(folder_ / "rows.csv", "mine");
  EXPECT_THROW(open(folder_ / "rows.csv", Opening::kNew), std::system_error);
  EXPECT_EQ(read_file(folder_ / "rows.csv"), "mine");
}

}  // namespace
}  // namespace hlc
