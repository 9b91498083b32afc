#include "hlc_bridge/doctor/shared_memory.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "tests/support/temporary_folder.hpp"

namespace hlc::doctor {
namespace {

namespace fs = std::filesystem;

void write(const fs::path& file, const std::string& text) {
  fs::create_directories(file.parent_path());
  std::ofstream(file) << text;
}

TEST(SharedMemory, AFileIsUsedByTheProcessesThatHaveItMapped) {
  const test::TemporaryFolder folder;
  const fs::path shm = folder / "shm";
  const fs::path proc = folder / "proc";
  for (const char* name :
       {"fastrtps_1234", "fastrtps_1234_el", "fastrtps_port7411", "sem.fastrtps_port7411_mutex",
        "fastrtps_port7420", "fastrtps_port7420_sl", "sem.fastrtps_port7420_mutex",
        "fast_datasharing_0a_1", "pulse-shm-1"}) {
    write(shm / name, "12345678");
  }
  write(proc / "17" / "maps",
        "7f00-7f10 rw-s 00000000 00:19 3 " + (shm / "fastrtps_1234").string() +
            "\n7f20-7f30 rw-s 00000000 00:19 4 " + (shm / "fastrtps_port7420").string() + "\n");
  write(proc / "17" / "comm", "middleware\n");
  write(proc / "self" / "maps",
        "7f00-7f10 rw-s 00000000 00:19 3 " + (shm / "fastrtps_port7411").string() + "\n");

  const std::vector<SharedMemoryFile> files = shared_memory_files(shm, proc);
  ASSERT_EQ(files.size(), 8U) << "all but that of other software";
  for (const SharedMemoryFile& file : files) {
    const bool is_used = file.name.find("fastrtps_1234") != std::string::npos ||
                         file.name.find("port7420") != std::string::npos;
    EXPECT_EQ(!file.users.empty(), is_used) << file.name;
    EXPECT_EQ(file.bytes, 8U);
  }
  const Finding finding = leftovers(files);
  EXPECT_EQ(finding.verdict, Verdict::kNote);
  EXPECT_EQ(finding.what.find("shared memory: 3 unused files in /dev/shm"), 0U);
  EXPECT_NE(finding.what.find("; 5 files in use by middleware (17)"), std::string::npos)
      << finding.what;
}

TEST(SharedMemory, NothingIsLeftOverWhereNothingIs) {
  const test::TemporaryFolder folder;
  EXPECT_TRUE(shared_memory_files(folder / "missing", folder / "missing").empty());
  EXPECT_EQ(leftovers({}).verdict, Verdict::kGood);
}

}  // namespace
}  // namespace hlc::doctor
