#include "planner/common/demand.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdio>
#include <cstdlib>

namespace hlc {
namespace {

template <class Number>
std::string digits(Number number) {
  std::array<char, 32> buffer{};
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), number).ptr;
  return {buffer.data(), end};
}

/// From the repository's root on, wherever the clone lies that was compiled.
std::string_view below_the_root(std::string_view file) {
  std::size_t begin = std::string_view::npos;
  for (const std::string_view top : {"/planner/", "/hlc_bridge/", "/vehicle_sim/", "/tests/"}) {
    const std::size_t found = file.rfind(top);
    if (found == std::string_view::npos) continue;
    begin = begin == std::string_view::npos ? found : std::max(begin, found);
  }
  return begin == std::string_view::npos ? file : file.substr(begin + 1);
}

}  // namespace

void DemandedValue::write(double number) { text_ = digits(number); }
void DemandedValue::write(std::int64_t number) { text_ = digits(number); }
void DemandedValue::write(std::uint64_t number) { text_ = digits(number); }

void demand_failed(std::string_view file, int line, std::string_view condition,
                   std::string_view names, std::initializer_list<DemandedValue> values) {
  std::string text(below_the_root(file));
  text += ":" + std::to_string(line) + ": demanded ";
  text += condition;
  if (values.size() > 0) {
    text += "; ";
    text += names;
    text += " = ";
    for (const DemandedValue& value : values) {
      if (&value != values.begin()) text += ", ";
      text += value.text();
    }
  }
  text += "\n";
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
  std::abort();
}

}  // namespace hlc
