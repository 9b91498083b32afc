#pragma once

#include <string>
#include <vector>

#include "hlc_bridge/record/run_folder.hpp"

namespace hlc::record {

/// In what two runs were started differently, one line each: the files of their scenarios by name
/// and text ("map: a.xml and b.xml", "scenario lab.yaml: other text from line 4 on"), and the keys
/// of configuration/flags.yaml by value ("noise_seed: 3 and null"). The folder of a file does not
/// count, nor does the DDS domain, which run_lab.sh draws. Nothing: they were started alike. A run
/// without copies of its files, before `summarize`, has them as they are now.
/// @throws std::invalid_argument, std::runtime_error naming the file that cannot be read
[[nodiscard]] std::vector<std::string> start_differences(const RunFolder& a, const RunFolder& b);

}  // namespace hlc::record
