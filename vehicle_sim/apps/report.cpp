#include "vehicle_sim/apps/report.hpp"

#include <unistd.h>

#include <cstdio>
#include <stdexcept>

#include "hlc_bridge/render/child_process.hpp"

namespace hlc::apps {
namespace {

/// This program is build/PRESET/bin/evaluate.
std::filesystem::path report_script() {
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe");
  return (program.parent_path() / "../../../vehicle_sim/report/report.sh").lexically_normal();
}

}  // namespace

void make_report(const std::filesystem::path& folder) {
  const std::filesystem::path script = report_script();
  if (::access(script.c_str(), X_OK) != 0) {
    throw std::runtime_error(script.string() + ": not found, must be as in the source folder");
  }
  std::fflush(stdout);
  render::ChildProcess process({script.string(), folder.string()},
                               {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO});
  if (!process.is_good_at_end()) {
    throw std::runtime_error(
        "the report was not made; the rows stay, and the same command goes on");
  }
}

}  // namespace hlc::apps
