#include "hlc_bridge/time/resident_memory.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <fstream>
#include <memory>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

namespace hlc::time {
namespace {

struct Pages {
  long all_kb{};
  long resident_kb{};
};

/// Of the mappings that hold code of a file.
Pages code_pages() {
  std::ifstream smaps("/proc/self/smaps");
  Pages pages;
  bool is_code = false;
  for (std::string line; std::getline(smaps, line);) {
    std::istringstream words(line);
    std::string first;
    std::string second;
    words >> first >> second;
    if (first.find('-') != std::string::npos) {
      is_code = second == "r-xp" && line.find('/') != std::string::npos;
    } else if (is_code && first == "Size:") {
      pages.all_kb += std::stol(second);
    } else if (is_code && first == "Rss:") {
      pages.resident_kb += std::stol(second);
    }
  }
  return pages;
}

long faults() {
  rusage usage{};
  getrusage(RUSAGE_THREAD, &usage);
  return usage.ru_minflt + usage.ru_majflt;
}

TEST(ResidentMemory, AllCodeIsInTheProcessBeforeItRuns) {
  const Pages before = code_pages();
  make_code_resident();
  const Pages after = code_pages();
  EXPECT_GT(after.all_kb, 0);
  EXPECT_LT(before.resident_kb, before.all_kb) << "nothing was left to be read";
  EXPECT_EQ(after.resident_kb, after.all_kb);
}

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kHasOwnHeap = false;  // the sanitizer's
#else
constexpr bool kHasOwnHeap = true;
#endif

long faults_of_new_blocks(int num_blocks) {
  const long before = faults();
  std::vector<std::unique_ptr<std::vector<char>>> blocks;
  for (int i = 0; i < num_blocks; ++i)
    blocks.push_back(std::make_unique<std::vector<char>>(4096, 'x'));
  return faults() - before;
}

TEST(ResidentMemory, BlocksOfAReservedHeapAreThereAndStay) {
  if (!kHasOwnHeap) GTEST_SKIP() << "with the heap of a sanitizer";
  long without = 0;
  long with = 0;
  long again = 0;
  std::thread([&] {  // a heap of its own, where nothing was freed yet
    without = faults_of_new_blocks(256);
    reserve_heap(std::size_t{4} << 20);
    with = faults_of_new_blocks(768);
    again = faults_of_new_blocks(768);
  })
      .join();
  EXPECT_GT(without, 200);
  EXPECT_EQ(with, 0);
  EXPECT_EQ(again, 0);
}

}  // namespace
}  // namespace hlc::time
