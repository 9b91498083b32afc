#include "vehicle_sim/apps/missing_runs.hpp"

#include <algorithm>
#include <iostream>

#include "planner/apps/parallel.hpp"
#include "planner/apps/progress_line.hpp"

namespace hlc::apps {

std::vector<std::size_t> missing_runs(std::size_t runs,
                                      const std::function<bool(std::size_t)>& has) {
  std::vector<std::size_t> missing;
  for (std::size_t run = 0; run < runs; ++run) {
    if (!has(run)) missing.push_back(run);
  }
  if (missing.size() < runs) {
    std::cerr << "evaluate: " << runs - missing.size() << " of " << runs
              << " runs already driven\n";
  }
  return missing;
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
