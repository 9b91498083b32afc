#include "planner/scenario/engine_choice.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>

#include "planner/search/ompl/ompl_engine.hpp"
#include "planner/search/search_options.hpp"

namespace hlc::scenario {

std::span<const NamedEngine> engines() {
  using search::Engine;
  static constexpr std::array kAll{
      NamedEngine{"branch_and_bound", Engine::kBranchAndBound, nullptr},
      NamedEngine{"best_first", Engine::kBestFirst, nullptr},
      NamedEngine{"ompl_branch_and_bound", Engine::kBranchAndBound, &search::make_ompl_engine},
      NamedEngine{"ompl_best_first", Engine::kBestFirst, &search::make_ompl_engine}};
  return kAll;
}

std::string engine_choices() {
  std::string names;
  for (const NamedEngine& one : engines()) {
    if (!names.empty()) names += ", ";
    names += one.name;
  }
  return names;
}

void choose_engine(const std::string& name, search::SearchOptions& search) {
  const auto found = std::ranges::find(engines(), name, &NamedEngine::name);
  if (found == engines().end()) {
    throw std::invalid_argument("engine = " + name + ", must be one of " + engine_choices());
  }
  search.engine = found->engine;
  search.factory = found->factory;
}

std::string engine_name(const search::SearchOptions& search) {
  const auto found = std::ranges::find_if(engines(), [&](const NamedEngine& one) {
    return one.engine == search.engine && one.factory == search.factory;
  });
  return found == engines().end() ? search::to_string(search.engine) : std::string(found->name);
}

}  // namespace hlc::scenario
