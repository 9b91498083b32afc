#include "planner/plot/drawing.hpp"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdio>

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

/// 0 if the program ends well.
int run(std::array<std::string, 4> command) {
  std::array<char*, 5> arguments{command[0].data(), command[1].data(), command[2].data(),
                                 command[3].data(), nullptr};
  pid_t child = 0;
  int status = 0;
  if (posix_spawn(&child, arguments[0], nullptr, nullptr, arguments.data(), environ) != 0 ||
      waitpid(child, &status, 0) != child) {
    std::fprintf(stderr, "%s: cannot be started, must be a program\n", arguments[0]);
    return kExitNotDrawn;
  }
  return WIFEXITED(status) && WEXITSTATUS(status) == 0 ? 0 : kExitNotDrawn;
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
  return run({program.string(), kind, file.string(), out.string()});
}

}  // namespace hlc::plot
