#pragma once

#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>

#include "tests/support/folders.hpp"
#include "tests/support/temporary_folder.hpp"

namespace hlc::test {

/// Identities of a run with these vehicles, by make_security.sh, for the life of the object.
class SecurityFolder {
 public:
  explicit SecurityFolder(const std::string& vehicle_ids) {
    const std::string command = test::source_folder() +
                                "/launch_scripts/make_security.sh --vehicle_ids " + vehicle_ids +
                                " --out " + path().string() + " > /dev/null";
    if (std::system(command.c_str()) != 0) throw std::runtime_error("failed: " + command);
  }
  [[nodiscard]] std::filesystem::path path() const { return folder_ / "security"; }

 private:
  TemporaryFolder folder_;
};

}  // namespace hlc::test
