#pragma once

#include <cstddef>
#include <vector>

namespace hlc::apps {

/// The share of a campaign's runs that one call drives: of `count` shards, numbered from 1, shard
/// `index` has the runs index - 1, index - 1 + count, ... So long and short runs spread evenly, and
/// every run is in one shard.
struct Shard {
  std::size_t index{1};
  std::size_t count{1};  ///< 1: all runs
};

/// Its numbers below `runs`, ascending. @pre 1 <= index <= count
[[nodiscard]] inline std::vector<std::size_t> runs_of(const Shard& shard, std::size_t runs) {
  std::vector<std::size_t> numbers;
  for (std::size_t run = shard.index - 1; run < runs; run += shard.count) numbers.push_back(run);
  return numbers;
}

}  // namespace hlc::apps
