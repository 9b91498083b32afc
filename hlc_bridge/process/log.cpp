#include "hlc_bridge/process/log.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

namespace hlc::process {
namespace {

spdlog::level::level_enum level_of(machine::Severity severity) {
  switch (severity) {
    case machine::Severity::kInfo:
      return spdlog::level::info;
    case machine::Severity::kWarning:
      return spdlog::level::warn;
    case machine::Severity::kError:
      break;
  }
  return spdlog::level::err;
}

}  // namespace

void log(const std::string& process, const machine::LogLine& line) {
  spdlog::log(level_of(line.severity),
              process.empty() ? line.text : fmt::format("{}: {}", process, line.text));
}

}  // namespace hlc::process
