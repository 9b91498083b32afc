#include "planner/scenario/engine_choice.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <stdexcept>
#include <string>

#include "planner/search/search_engine.hpp"

namespace hlc::scenario {
namespace {

TEST(EngineChoice, EveryNameChoosesAnEngineThatHasIt) {
  for (const NamedEngine& one : engines()) {
    search::SearchOptions chosen;
    choose_engine(std::string(one.name), chosen);
    EXPECT_EQ(chosen.engine, one.engine);
    EXPECT_EQ(chosen.factory, one.factory);
    EXPECT_EQ(engine_name(chosen), one.name);
    EXPECT_NE(engine_choices().find(one.name), std::string::npos);
  }
}

TEST(EngineChoice, AnEngineThatIsNotListedHasTheNameOfWhatItReplaces) {
  const search::EngineFactory own =
      [](const automaton::Subgraph&, const automaton::ReachableSets&, const search::SearchOptions&,
         std::shared_ptr<const search::SearchTables>) -> std::unique_ptr<search::SearchEngine> {
    return nullptr;
  };
  EXPECT_EQ(engine_name({.engine = search::Engine::kBestFirst, .factory = own}), "best_first");
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
