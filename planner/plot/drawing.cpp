#include "planner/plot/drawing.hpp"

#include <cstdio>

#include "planner/common/run_program.hpp"
#include "planner/common/temporary_folder.hpp"
#include "planner/common/text_file.hpp"

namespace hlc::plot {
namespace {

namespace fs = std::filesystem;

fs::path script() { return fs::read_symlink("/proc/self/exe").parent_path() / "report/draw.sh"; }

}  // namespace

int draw(const std::string& kind, const nlohmann::ordered_json& data, const fs::path& out) {
  const fs::path program = script();
  if (!fs::exists(program)) {
    std::fprintf(stderr, "--plot = %s: %s is missing, must be beside the program\n", out.c_str(),
                 program.c_str());
    return kExitNotDrawn;
  }
  const TemporaryFolder folder;
  const fs::path file = folder / "drawing.json";
  write_file(file, data.dump());
  return run_program({program.string(), kind, file.string(), out.string()}) ? 0 : kExitNotDrawn;
}

}  // namespace hlc::plot
