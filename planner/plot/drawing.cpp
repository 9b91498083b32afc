#include "planner/plot/drawing.hpp"

#include <cstdio>

#include "planner/common/run_program.hpp"
#include "planner/common/temporary_folder.hpp"
#include "planner/common/text_file.hpp"

namespace hlc::plot {
namespace {

namespace fs = std::filesystem;

/// Where a program of the build tree and one of a flat folder find it.
fs::path script() {
  const fs::path folder = fs::read_symlink("/proc/self/exe").parent_path();
  const fs::path beside = folder / "report/draw.sh";
  const fs::path of_sources = folder / "../../../vehicle_sim/report/draw.sh";
  return fs::exists(beside) || !fs::exists(of_sources) ? beside : of_sources.lexically_normal();
}

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
