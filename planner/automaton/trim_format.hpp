#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <string_view>

#include "planner/automaton/trim_id.hpp"

/// Trims as users number them, from 1: "3"; edges as "3 -> 7".
template <>
struct fmt::formatter<hlc::TrimId> : fmt::formatter<std::size_t> {
  // Not a template: every file that names a trim would otherwise compile how a number is written.
  fmt::appender format(hlc::TrimId trim, fmt::format_context& context) const;
};

template <>
struct fmt::formatter<hlc::TrimPair> : fmt::formatter<std::string_view> {
  fmt::appender format(const hlc::TrimPair& edge, fmt::format_context& context) const;
};
