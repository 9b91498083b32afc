#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "vehicle_sim/campaign/run_figures.hpp"

namespace hlc::apps {

/// Those of `runs` without a record. Prints on stderr how many have one.
[[nodiscard]] std::vector<std::size_t> missing_runs(std::vector<std::size_t> runs,
                                                    const std::function<bool(std::size_t)>& has);

/// Calls task(number) for every number of the list, `jobs` at a time, with a progress line on
/// stderr.
/// @param what  subject of the numbers, for the progress line
void for_each_number(const std::vector<std::size_t>& numbers, const std::string& what,
                     std::size_t jobs, const std::function<void(std::size_t)>& task);

/// Number of runs that do not count.
[[nodiscard]] std::size_t num_failed(const std::vector<campaign::RunFigures>& runs);

}  // namespace hlc::apps
