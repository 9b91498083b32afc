#include "vehicle_sim/apps/missing_runs.hpp"

#include <algorithm>
#include <iostream>

#include "planner/apps/parallel.hpp"
#include "planner/apps/progress_line.hpp"

namespace hlc::apps {

std::vector<std::size_t> missing_runs(std::vector<std::size_t> runs,
                                      const std::function<bool(std::size_t)>& has) {
  const std::size_t all = runs.size();
  const std::size_t driven = std::erase_if(runs, has);
  if (driven > 0) std::cerr << "evaluate: " << driven << " of " << all << " runs already driven\n";
  return runs;
}

void for_each_number(const std::vector<std::size_t>& numbers, const std::string& what,
                     std::size_t jobs, const std::function<void(std::size_t)>& task) {
  const ProgressLine progress(what, numbers.size());
  run_parallel(
      numbers.size(), jobs, [&](std::size_t i) { task(numbers[i]); },
      [&](std::size_t done) { progress.show(done); });
}

std::size_t num_failed(const std::vector<campaign::RunFigures>& runs) {
  return static_cast<std::size_t>(std::ranges::count_if(
      runs, [](const campaign::RunFigures& run) { return !campaign::is_well_driven(run); }));
}

}  // namespace hlc::apps
