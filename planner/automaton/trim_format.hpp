#pragma once

#include <fmt/format.h>

#include <cstddef>

#include "planner/automaton/trim_id.hpp"

/// Trims as users number them, from 1: "3"; edges as "3 -> 7".
template <>
struct fmt::formatter<hlc::TrimId> : fmt::formatter<std::size_t> {
  template <class Context>
  auto format(hlc::TrimId trim, Context& context) const {
    return formatter<std::size_t>::format(trim.index + 1, context);
  }
};

template <>
struct fmt::formatter<hlc::TrimPair> : fmt::formatter<hlc::TrimId> {
  template <class Context>
  auto format(const hlc::TrimPair& edge, Context& context) const {
    return fmt::format_to(context.out(), "{} -> {}", edge.from, edge.to);
  }
};
