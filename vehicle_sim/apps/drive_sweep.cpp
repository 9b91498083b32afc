#include "vehicle_sim/apps/drive_sweep.hpp"

#include <algorithm>
#include <iostream>
#include <set>

#include "planner/apps/parallel.hpp"
#include "planner/apps/progress_line.hpp"

namespace hlc {
namespace {

/// Does task(i) for every number of the list.
void for_each(const std::vector<std::size_t>& numbers, const std::string& what, std::size_t jobs,
              const std::function<void(std::size_t)>& task) {
  const ProgressLine progress(what, numbers.size());
  run_parallel(
      numbers.size(), jobs, [&](std::size_t i) { task(numbers[i]); },
      [&](std::size_t done) { progress.show(done); });
}

}  // namespace

std::size_t drive_sweep(Sweep& sweep, std::size_t jobs, SweepFiles& files) {
  if (files.size() > 0) {
    std::cerr << "evaluate: " << files.size() << " of " << sweep.runs().size()
              << " runs are there already\n";
  }
  std::vector<std::size_t> missing;
  std::set<std::size_t> automata;
  for (std::size_t run = 0; run < sweep.runs().size(); ++run) {
    if (files.has(run)) continue;
    missing.push_back(run);
    automata.insert(sweep.automaton_of(run));
  }
  for_each({automata.begin(), automata.end()}, "automaton", jobs,
           [&](std::size_t automaton) { sweep.build(automaton); });
  for_each(missing, "run", jobs, [&](std::size_t run) { files.add(run, sweep.drive(run)); });
  const std::vector<RunFigures> figures = files.figures();
  return static_cast<std::size_t>(
      std::ranges::count_if(figures, [](const RunFigures& run) { return !run.failure.empty(); }));
}

}  // namespace hlc
