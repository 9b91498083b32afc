#pragma once

#include <filesystem>

namespace hlc::apps {

/// Makes the page report.md of a campaign's or sweep's folder, by vehicle_sim/report/report.sh. Its
/// messages go to this program's output and errors.
/// @param folder  with campaign.json and runs.csv
/// @throws std::runtime_error with one line if the script is not found or fails
void make_report(const std::filesystem::path& folder);

}  // namespace hlc::apps
