#include "planner/common/word_hash.hpp"

#include <gtest/gtest.h>

#include <set>

namespace hlc {
namespace {

TEST(WordHash, EqualWordsInEqualOrderGiveEqualHashes) {
  WordHash a;
  WordHash b;
  for (const double number : {1.0, 2.0}) a.add(number);
  for (const double number : {1.0, 2.0}) b.add(number);
  EXPECT_EQ(a.value(), b.value());
  WordHash turned;
  for (const double number : {2.0, 1.0}) turned.add(number);
  EXPECT_NE(turned.value(), a.value());
}

// A rounding of the last bit must not be missed, nor zeros.
TEST(WordHash, EveryBitAndEveryWordCounts) {
  std::set<std::uint64_t> hashes;
  for (unsigned bit = 0; bit < 64; ++bit) {
    WordHash hash;
    hash.add(std::uint64_t{7});
    hash.add(std::uint64_t{1} << bit);
    hash.add(std::uint64_t{9});
    hashes.insert(hash.value());
  }
  WordHash zeros;
  hashes.insert(zeros.value());
  for (int i = 0; i < 10; ++i) {
    zeros.add(std::uint64_t{0});
    hashes.insert(zeros.value());
  }
  EXPECT_EQ(hashes.size(), 64U + 11U);
}

TEST(WordHash, TextsAreNotJoined) {
  WordHash a;
  a.add("ab");
  a.add("c");
  WordHash b;
  b.add("a");
  b.add("bc");
  EXPECT_NE(a.value(), b.value());
}

}  // namespace
}  // namespace hlc
