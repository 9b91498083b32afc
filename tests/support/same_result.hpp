#pragma once

#include <gtest/gtest.h>

#include "planner/search/horizon_problem.hpp"

namespace hlc::test {

/// Expects two results to be bitwise identical.
inline void expect_same(const search::SearchResult& a, const search::SearchResult& b) {
  EXPECT_EQ(a.status, b.status);
  EXPECT_EQ(a.reason, b.reason);
  EXPECT_EQ(a.cost, b.cost);
  EXPECT_EQ(a.lower_bound, b.lower_bound);
  EXPECT_EQ(a.maneuvers, b.maneuvers);
  EXPECT_EQ(a.poses, b.poses);
  EXPECT_EQ(a.generated, b.generated);
  EXPECT_EQ(a.expanded, b.expanded);
}

}  // namespace hlc::test
