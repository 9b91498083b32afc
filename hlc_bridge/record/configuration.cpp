#include "hlc_bridge/record/configuration.hpp"

#include <stdexcept>
#include <system_error>

#include "hlc_bridge/record/text_file.hpp"

namespace hlc {

void keep_configuration(const std::filesystem::path& run_folder,
                        const std::vector<std::filesystem::path>& files) {
  for (const std::filesystem::path& file : files) {
    const std::filesystem::path full = std::filesystem::absolute(file).lexically_normal();
    const std::filesystem::path folder =
        run_folder / "configuration" / full.parent_path().filename();
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error) {
      throw std::runtime_error(folder.string() + ": cannot be made");
    }
    write_file(folder / full.filename(), read_file(full));
  }
}

}  // namespace hlc
