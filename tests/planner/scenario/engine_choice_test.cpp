#include "planner/scenario/engine_choice.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "planner/search/ompl/ompl_engine.hpp"

namespace hlc::scenario {
namespace {

TEST(EngineChoice, EveryNameChoosesAnEngineThatSaysIt) {
  for (const search::Engine engine :
       {search::Engine::kBranchAndBound, search::Engine::kBestFirst}) {
    for (const search::EngineFactory factory :
         {search::EngineFactory{nullptr}, search::EngineFactory{search::make_ompl_engine}}) {
      const std::string name = engine_name({.engine = engine, .factory = factory});
      EXPECT_NE(std::string(kEngineChoices).find(name), std::string::npos);
      search::SearchOptions chosen;
      choose_engine(name, chosen);
      EXPECT_EQ(chosen.engine, engine);
      EXPECT_EQ(chosen.factory, factory);
    }
  }
}

TEST(EngineChoice, RefusesOtherNames) {
  for (const char* name :
       {"", "ompl", "ompl_", "fast", "branch_and_bound_ompl", "ompl_ompl_best_first"}) {
    search::SearchOptions untouched;
    EXPECT_THROW(choose_engine(name, untouched), std::invalid_argument) << name;
    EXPECT_EQ(engine_name(untouched), engine_name({}));
  }
}

}  // namespace
}  // namespace hlc::scenario
