#include "vehicle_sim/apps/drive_sweep.hpp"

#include <set>

#include "vehicle_sim/apps/missing_runs.hpp"
#include "vehicle_sim/apps/shard.hpp"

namespace hlc::apps {

std::size_t drive_sweep(campaign::Sweep& sweep, std::size_t jobs, SweepFiles& files) {
  const std::vector<std::size_t> missing = missing_runs(
      runs_of({}, sweep.runs().size()), [&](std::size_t run) { return files.has(run); });
  std::set<std::size_t> automata;
  for (const std::size_t run : missing) automata.insert(sweep.automaton_of(run));
  for_each_number({automata.begin(), automata.end()}, "automaton", jobs,
                  [&](std::size_t automaton) { sweep.build(automaton); });
  for_each_number(missing, "run", jobs, [&](std::size_t run) { files.add(run, sweep.drive(run)); });
  return num_failed(files.figures());
}

}  // namespace hlc::apps
