#include "hlc_bridge/process/log.hpp"

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
  const std::string prefix = process.empty() ? "" : process + ": ";
  spdlog::log(level_of(line.severity), "{}{}", prefix, line.text);
}

}  // namespace hlc::process
