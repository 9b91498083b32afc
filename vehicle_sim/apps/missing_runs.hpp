#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "vehicle_sim/campaign/run_figures.hpp"

namespace hlc {

/// The numbers below `runs` that are not there yet. Says on stderr how many are.
[[nodiscard]] std::vector<std::size_t> missing_runs(std::size_t runs,
                                                    const std::function<bool(std::size_t)>& has);

/// Does task(number) for every number of the list, `jobs` at a time, with a progress line on
/// stderr.
/// @param what  each number is of, for the progress line
void for_each_number(const std::vector<std::size_t>& numbers, const std::string& what,
                     std::size_t jobs, const std::function<void(std::size_t)>& task);

/// How many runs do not count.
[[nodiscard]] std::size_t num_failed(const std::vector<RunFigures>& runs);

}  // namespace hlc
