#include "planner/search/search_options.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

namespace hlc::search {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(SearchOptions, EveryNameLeadsBackToWhatItNames) {
  for (const Engine engine : {Engine::kBranchAndBound, Engine::kBestFirst}) {
    EXPECT_EQ(engine_from_name(to_string(engine)), engine);
    EXPECT_THAT(kEngineNames, HasSubstr(to_string(engine)));
  }
  for (const CostToGo one :
       {CostToGo::kReachable, CostToGo::kStraightLine, CostToGo::kReferenceSpeed}) {
    EXPECT_EQ(cost_to_go_from_name(to_string(one)), one);
    EXPECT_THAT(kCostToGoNames, HasSubstr(to_string(one)));
  }
}

TEST(SearchOptions, AnUnknownNameIsRefusedWithThoseThereAre) {
  EXPECT_THAT([] { static_cast<void>(engine_from_name("fast")); },
              ThrowsMessage<std::invalid_argument>(
                  "engine = fast, must be one of branch_and_bound, best_first"));
  EXPECT_THAT([] { static_cast<void>(cost_to_go_from_name("")); },
              ThrowsMessage<std::invalid_argument>(
                  "cost_to_go = , must be one of reachable, straight_line, 2022"));
}

TEST(SearchOptions, BranchAndBoundSearchesWithTheReachableCostToGoOnly) {
  for (const CostToGo one :
       {CostToGo::kReachable, CostToGo::kStraightLine, CostToGo::kReferenceSpeed}) {
    EXPECT_NO_THROW(check_search_options({.engine = Engine::kBestFirst, .cost_to_go = one}));
  }
  EXPECT_NO_THROW(check_search_options({.engine = Engine::kBranchAndBound}));
  for (const CostToGo one : {CostToGo::kStraightLine, CostToGo::kReferenceSpeed}) {
    EXPECT_THROW(check_search_options({.engine = Engine::kBranchAndBound, .cost_to_go = one}),
                 std::invalid_argument);
  }
  EXPECT_THROW(check_search_options({.max_expansions = 0}), std::invalid_argument);
}

}  // namespace
}  // namespace hlc::search
