#include "hlc_bridge/messages/node_names.hpp"

#include <algorithm>
#include <string_view>

namespace hlc {
namespace {

// Without <regex>, which takes longer to compile than the rest of this folder.

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// The numbers of a list of two or more; empty if the text is none.
std::vector<std::string> numbers_in(std::string_view list, std::string_view separator) {
  std::vector<std::string> numbers;
  while (true) {
    const std::string_view number = list.substr(0, list.find(separator));
    if (number.empty() || !std::ranges::all_of(number, &is_digit)) return {};
    numbers.emplace_back(number);
    if (number.size() == list.size()) break;
    list.remove_prefix(number.size() + separator.size());
  }
  return numbers.size() > 1 ? numbers : std::vector<std::string>{};
}

/// `begin` + number + `end` for each number; the name itself if there are none.
std::vector<std::string> one_each(const std::string& name, const std::vector<std::string>& numbers,
                                  std::string_view begin, std::string_view end) {
  if (numbers.empty()) return {name};
  std::vector<std::string> names;
  for (const std::string& number : numbers) {
    names.push_back(std::string(begin) + number + std::string(end));
  }
  return names;
}

}  // namespace

std::vector<std::string> process_names(const std::string& name) {
  const std::size_t list = name.rfind('_') + 1;
  if (list == 0) return {name};
  const std::string_view text = name;
  return one_each(name, numbers_in(text.substr(list), ","), text.substr(0, list), "");
}

std::vector<std::string> single_ready_ids(const std::string& source_id) {
  constexpr std::string_view kBegin = "MW for muCars ";
  constexpr std::string_view kEnd = " ready.";
  if (!source_id.starts_with(kBegin) || !source_id.ends_with(kEnd) ||
      source_id.size() < kBegin.size() + kEnd.size()) {
    return {source_id};
  }
  std::string_view list = source_id;
  list.remove_prefix(kBegin.size());
  list.remove_suffix(kEnd.size());
  return one_each(source_id, numbers_in(list, ", "), kBegin, kEnd);
}

}  // namespace hlc
