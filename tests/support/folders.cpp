#include "tests/support/folders.hpp"

namespace hlc::test {

const std::string& source_folder() {
  static const std::string folder = HLC_SOURCE_DIR;
  return folder;
}

const std::string& build_folder() {
  static const std::string folder = HLC_BINARY_DIR;
  return folder;
}

}  // namespace hlc::test
