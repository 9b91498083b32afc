#pragma once

#include <filesystem>
#include <vector>

namespace hlc {

/// Copies the files that a run was configured with into
/// `<run_folder>/configuration/<folder>/<file>`, where <folder> is the name of the folder that a
/// file lies in: paths from one to another such as
/// `../maps/lab_like.xml` stay good, so the run can be repeated from its folder.
/// @throws std::runtime_error naming the file
void keep_configuration(const std::filesystem::path& run_folder,
                        const std::vector<std::filesystem::path>& files);

}  // namespace hlc
