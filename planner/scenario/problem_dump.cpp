#include "planner/scenario/problem_dump.hpp"

#include <fmt/format.h>

#include <unistd.h>

#include <span>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "planner/scenario/problem_file.hpp"

namespace hlc::scenario {

ProblemDump::ProblemDump(std::filesystem::path folder, const std::filesystem::path& automaton_file,
                         automaton::SubgraphSpec declared)
    : folder_(std::move(folder)),
      automaton_file_(std::filesystem::absolute(automaton_file).lexically_normal()),
      declared_(std::move(declared)) {
  std::error_code error;
  std::filesystem::create_directories(folder_, error);
  if (error || access(folder_.c_str(), W_OK | X_OK) != 0) {
    throw std::invalid_argument("--dump-problems = " + folder_.string() +
                                ", must be a folder that can be created and written to");
  }
}

void ProblemDump::write(const controller::Controller& controller) const {
  const controller::ControllerOptions& options = controller.options();
  if (controller.subgraph().spec() != declared_) {
    throw std::runtime_error(
        fmt::format("problems on subgraph '{}' cannot be written: {} does not declare it",
                    controller.subgraph().spec().name, automaton_file_.string()));
  }
  const auto write_all = [&](std::span<const search::HorizonProblem> problems, const char* what) {
    std::size_t number = 0;
    for (const search::HorizonProblem& problem : problems) {
      const std::string name =
          fmt::format("vehicle_{}_step_{:010}_{}_{}.json", options.vehicle.value,
                      controller.last_step().value, what, ++number);
      write_problem_file({.automaton_file = automaton_file_,
                          .subgraph = controller.prepared_subgraph().subgraph,
                          .problem = problem,
                          .search = options.search},
                         folder_ / name);
    }
  };
  write_all(controller.entry_problems(), "lane_entry");
  write_all(controller.problems(), "search");
}

}  // namespace hlc::scenario
