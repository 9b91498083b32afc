#include "planner/automaton/trim_format.hpp"

#include <string>

fmt::appender fmt::formatter<hlc::TrimId>::format(hlc::TrimId trim,
                                                  fmt::format_context& context) const {
  return formatter<std::size_t>::format(trim.index + 1, context);
}

fmt::appender fmt::formatter<hlc::TrimPair>::format(const hlc::TrimPair& edge,
                                                    fmt::format_context& context) const {
  const std::string text = fmt::format("{} -> {}", edge.from, edge.to);
  return formatter<std::string_view>::format(text, context);
}
