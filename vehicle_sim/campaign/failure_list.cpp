#include "vehicle_sim/campaign/failure_list.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <regex>

namespace hlc::campaign {
namespace {

constexpr std::size_t kReasonsShown = 20;

/// A reason without its numbers: "vehicle # was out of its areas in # steps".
struct Reason {
  std::string text;
  std::vector<std::string> numbers;
};

constexpr char kNumberHere = '#';

Reason reason_of(const std::string& failure) {
  static const std::regex number_text("[0-9]+([.][0-9]+)?");
  Reason reason;
  for (std::sregex_iterator it(failure.begin(), failure.end(), number_text), end; it != end; ++it) {
    reason.numbers.push_back(it->str());
  }
  reason.text = std::regex_replace(failure, number_text, std::string(1, kNumberHere));
  return reason;
}

/// The runs that failed for the same reason.
struct Failures {
  std::size_t count{};
  std::vector<std::string> least;  ///< of the reason's numbers
  std::vector<std::string> largest;

  void add(const std::vector<std::string>& numbers) {
    if (count++ == 0) least = largest = numbers;
    for (std::size_t i = 0; i < std::min(numbers.size(), least.size()); ++i) {
      if (std::stod(numbers[i]) < std::stod(least[i])) least[i] = numbers[i];
      if (std::stod(numbers[i]) > std::stod(largest[i])) largest[i] = numbers[i];
    }
  }

  [[nodiscard]] std::string in_words(const std::string& reason) const {
    std::string text;
    std::size_t number = 0;
    for (const char letter : reason) {
      if (letter != kNumberHere || number == least.size()) {
        text += letter;
        continue;
      }
      text += least[number];
      if (largest[number] != least[number]) text += " … " + largest[number];
      ++number;
    }
    return text;
  }
};

}  // namespace

std::string failure_list(const std::vector<RunFigures>& runs) {
  std::map<std::string, Failures> by_reason;
  std::size_t failed = 0;
  for (const RunFigures& run : runs) {
    if (is_well_driven(run)) continue;
    ++failed;
    const Reason reason = reason_of(run.failure);
    by_reason["subgraph " + run.subgraph + ": " + reason.text].add(reason.numbers);
  }
  if (failed == 0) return "";
  std::vector<std::pair<std::string, Failures>> reasons(by_reason.begin(), by_reason.end());
  std::ranges::stable_sort(reasons, std::ranges::greater{},
                           [](const auto& reason) { return reason.second.count; });
  std::string text = fmt::format("## Runs that do not count: {}\n\n", failed);
  for (std::size_t i = 0; i < std::min(kReasonsShown, reasons.size()); ++i) {
    const auto& [reason, failures] = reasons[i];
    text += fmt::format("* {} times {}\n", failures.count, failures.in_words(reason));
  }
  if (reasons.size() > kReasonsShown) {
    text += fmt::format("* and {} other reasons, see sweep.csv\n", reasons.size() - kReasonsShown);
  }
  return text + "\n";
}

}  // namespace hlc::campaign
