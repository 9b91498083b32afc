#pragma once

#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <cstdlib>
#include <memory>
#include <string>

#include "planner/apps/flags.hpp"

namespace hlc::apps {

/// Of the default log: the least severe messages that are logged, and no colours if the environment
/// variable NO_COLOR is set and not empty (a pipe or file never has any).
inline void set_up_log(const std::string& level) {
  spdlog::set_level(spdlog::level::from_str(level));
  const char* const no_color = std::getenv("NO_COLOR");
  if (no_color == nullptr || *no_color == '\0') return;
  for (const spdlog::sink_ptr& sink : spdlog::default_logger()->sinks()) {
    const auto coloured = std::dynamic_pointer_cast<spdlog::sinks::stdout_color_sink_mt>(sink);
    if (coloured) coloured->set_color_mode(spdlog::color_mode::never);
  }
}

/// --log_level of every program with a log, which it sets up once the flags are parsed.
inline void declare_log_level(CLI::App& app) {
  const auto level = std::make_shared<std::string>("info");
  app.add_option("--log_level", *level, "least severe messages that are logged")
      ->check(among({"trace", "debug", "info", "warning", "error", "critical", "off"}))
      ->envname("HLC_LOG_LEVEL")
      ->capture_default_str();
  app.parse_complete_callback([level] { set_up_log(*level); });
}

}  // namespace hlc::apps
