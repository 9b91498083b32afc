#include "planner/scenario/problem_dump.hpp"

#include <fmt/format.h>

#include <unistd.h>

#include <algorithm>
#include <memory>
#include <set>
#include <span>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "planner/common/sha256.hpp"
#include "planner/common/text_file.hpp"
#include "planner/maneuver_design/automaton_configuration.hpp"
#include "planner/maneuver_design/built_automaton.hpp"
#include "planner/scenario/problem_file.hpp"

namespace hlc::scenario {
namespace {

/// Whether the problem needs more of the automaton than the part that its subgraph enables: after a
/// switch it may start from a disabled trim, or its plan in force have disabled edges.
bool needs_disabled(const automaton::Subgraph& subgraph, const search::HorizonProblem& problem) {
  const auto is_enabled_edge = [&](const automaton::Maneuver* maneuver) {
    const auto edges = subgraph.successors(maneuver->from);
    return subgraph.is_enabled(maneuver->from) &&
           std::ranges::find(edges, maneuver, &automaton::Edge::maneuver) != edges.end();
  };
  return !subgraph.is_enabled(problem.start_trim) ||
         !std::ranges::all_of(problem.incumbent, is_enabled_edge);
}

/// Those of the plan in force that the subgraph's automaton does not hold: designed for weights
/// that were requested before.
std::vector<const automaton::Maneuver*> foreign_maneuvers(const automaton::Subgraph& subgraph,
                                                          const search::HorizonProblem& problem) {
  std::vector<const automaton::Maneuver*> foreign;
  for (const automaton::Maneuver* maneuver : problem.incumbent) {
    const automaton::Maneuver* held =
        subgraph.automaton().find(maneuver->from, maneuver->to, maneuver->label);
    const bool is_known = (held != nullptr && held->label == maneuver->label) ||
                          std::ranges::any_of(foreign, [maneuver](const automaton::Maneuver* one) {
                            return one->from == maneuver->from && one->to == maneuver->to &&
                                   one->label == maneuver->label;
                          });
    if (!is_known) foreign.push_back(maneuver);
  }
  return foreign;
}

std::vector<std::string> labels_of(const automaton::UniversalAutomaton& automaton) {
  std::set<std::string> labels;
  for (const automaton::Maneuver& maneuver : automaton.maneuvers) {
    if (!maneuver.is_self_loop()) labels.insert(maneuver.label);
  }
  return {labels.begin(), labels.end()};
}

/// Of a scenario's automaton: the file's origin, without automaton and subgraphs.
automaton::AutomatonFile origin_of(const std::filesystem::path& path) {
  automaton::AutomatonFile file =
      automaton::is_automaton_file(path)
          ? automaton::read_automaton_file(path)
          : maneuver_design::file_of(maneuver_design::read_automaton_configuration(path), {});
  file.automaton = nullptr;
  file.subgraphs.clear();
  return file;
}

}  // namespace

ProblemDump::ProblemDump(std::filesystem::path folder, const std::filesystem::path& automaton_file,
                         automaton::SubgraphSpec declared)
    : folder_(std::move(folder)),
      automaton_file_(std::filesystem::absolute(automaton_file).lexically_normal()),
      declared_(std::move(declared)) {
  std::error_code error;
  std::filesystem::create_directories(folder_, error);
  if (error || access(folder_.c_str(), W_OK | X_OK) != 0) {
    throw std::invalid_argument("folder of the planning problems = " + folder_.string() +
                                ", must be a folder that can be created and written to");
  }
}

std::filesystem::path ProblemDump::automaton_file_for(const controller::SearchedProblem& searched) {
  const automaton::Subgraph& subgraph = *searched.subgraph;
  if (subgraph.spec() == declared_ && !needs_disabled(subgraph, searched.problem)) {
    return automaton_file_;
  }
  const Foreign foreign = foreign_maneuvers(subgraph, searched.problem);
  if (!foreign.empty()) return write_automaton(subgraph, foreign);
  const auto known = std::ranges::find_if(written_, [&](const auto& one) {
    return one.first->spec() == subgraph.spec() &&
           one.first->shared_automaton() == subgraph.shared_automaton();
  });
  if (known != written_.end()) return known->second;
  const auto& written = written_.emplace_back(searched.subgraph, write_automaton(subgraph, {}));
  return written.second;
}

std::filesystem::path ProblemDump::write_automaton(const automaton::Subgraph& subgraph,
                                                   const Foreign& foreign) {
  if (!origin_) origin_ = origin_of(automaton_file_);
  automaton::AutomatonFile file = *origin_;
  automaton::UniversalAutomaton automaton = subgraph.automaton();
  automaton::SubgraphSpec& spec = file.subgraphs.emplace_back(subgraph.spec());
  for (const automaton::Maneuver* maneuver : foreign) {
    automaton.maneuvers.push_back(*maneuver);
    // The exits from disabled trims (subgraph.hpp) stay those of the given automaton.
    if (!subgraph.is_enabled(maneuver->from)) {
      spec.disabled_edges.push_back({{maneuver->from, maneuver->to}, maneuver->label});
    }
  }
  file.labels = labels_of(automaton);
  file.automaton = std::make_shared<const automaton::UniversalAutomaton>(std::move(automaton));
  const std::string text = automaton::to_text(file);
  constexpr std::size_t kDigits = 12;
  std::filesystem::path name = fmt::format("automaton_{}.yaml", sha256_of(text).substr(0, kDigits));
  write_file(folder_ / name, text);
  return name;
}

void ProblemDump::write(const controller::Controller& controller) {
  const controller::ControllerOptions& options = controller.options();
  const auto write_one = [&](const controller::SearchedProblem& searched, const char* what,
                             std::size_t number) {
    const std::string name = fmt::format("vehicle_{}_step_{:010}_{}_{}.json", options.vehicle.value,
                                         controller.last_step().value, what, number);
    ProblemFile file{.automaton_file = automaton_file_for(searched),
                     .subgraph = searched.subgraph,
                     .problem = searched.problem,
                     .search = options.search};
    file.search.max_expansions = std::max<std::size_t>(searched.max_expansions, 1);
    write_problem_file(file, folder_ / name);
  };
  std::size_t number = 0;
  for (const search::HorizonProblem& problem : controller.entry_problems()) {
    write_one({problem, controller.prepared_subgraph().subgraph, options.search.max_expansions},
              "lane_entry", ++number);
  }
  number = 0;
  for (const controller::SearchedProblem& searched : controller.problems()) {
    write_one(searched, "search", ++number);
  }
}

}  // namespace hlc::scenario
