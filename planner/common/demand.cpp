#include "planner/common/demand.hpp"

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

}  // namespace

void DemandedValue::write(double number) { text_ = digits(number); }
void DemandedValue::write(std::int64_t number) { text_ = digits(number); }
void DemandedValue::write(std::uint64_t number) { text_ = digits(number); }

void demand_failed(std::string_view file, int line, std::string_view condition,
                   std::string_view names, std::initializer_list<DemandedValue> values) {
  std::string text(file);
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
