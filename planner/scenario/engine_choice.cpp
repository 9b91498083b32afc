#include "planner/scenario/engine_choice.hpp"

#include <stdexcept>
#include <string_view>

#include "planner/search/ompl/ompl_engine.hpp"
#include "planner/search/search_options.hpp"

namespace hlc::scenario {
namespace {

constexpr std::string_view kThroughOmpl = "ompl_";

}  // namespace

void choose_engine(const std::string& name, search::SearchOptions& search) {
  const bool is_through_ompl = name.starts_with(kThroughOmpl);
  try {
    search.engine =
        search::engine_from_name(is_through_ompl ? name.substr(kThroughOmpl.size()) : name);
  } catch (const std::invalid_argument&) {
    throw std::invalid_argument("engine = " + name + ", must be one of " + kEngineChoices);
  }
  search.factory = is_through_ompl ? search::make_ompl_engine : nullptr;
}

std::string engine_name(const search::SearchOptions& search) {
  const std::string name = search::to_string(search.engine);
  return search.factory == search::make_ompl_engine ? std::string(kThroughOmpl) + name : name;
}

}  // namespace hlc::scenario
