#include "planner/scenario/problem_dump.hpp"

#include <unistd.h>

#include <cstdio>
#include <span>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "planner/scenario/problem_file.hpp"

namespace hlc {

ProblemDump::ProblemDump(std::filesystem::path folder, const std::filesystem::path& automaton_file,
                         SubgraphSpec declared)
    : folder_(std::move(folder)),
      automaton_file_(std::filesystem::absolute(automaton_file).lexically_normal()),
      declared_(std::move(declared)) {
  std::error_code error;
  std::filesystem::create_directories(folder_, error);
  if (error || access(folder_.c_str(), W_OK | X_OK) != 0) {
    throw std::invalid_argument("--dump-problems = " + folder_.string() +
                                ", allowed a folder that can be made and written to");
  }
}

void ProblemDump::write(const Controller& controller) const {
  const ControllerOptions& options = controller.options();
  if (controller.subgraph().spec() != declared_) {
    throw std::runtime_error("problems on subgraph '" + controller.subgraph().spec().name +
                             "' cannot be written, which " + automaton_file_.string() +
                             " does not declare");
  }
  const auto write_all = [&](std::span<const HorizonProblem> problems, const char* what) {
    std::size_t number = 0;
    for (const HorizonProblem& problem : problems) {
      char name[96];
      std::snprintf(name, sizeof(name), "vehicle_%u_step_%010llu_%s_%zu.json",
                    static_cast<unsigned>(options.vehicle.value),
                    static_cast<unsigned long long>(controller.last_step().value), what, ++number);
      write_problem_file({.automaton_file = automaton_file_,
                          .subgraph = controller.prepared_subgraph().subgraph,
                          .problem = problem,
                          .search = options.search},
                         folder_ / name);
    }
  };
  write_all(controller.entry_problems(), "joining");
  write_all(controller.problems(), "search");
}

}  // namespace hlc
