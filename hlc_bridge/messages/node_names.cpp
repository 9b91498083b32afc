#include "hlc_bridge/messages/node_names.hpp"

#include <regex>

namespace hlc {
namespace {

/// Made together: two threads that compile patterns at the same time race for a cache of the
/// locale (std::ctype<char>::narrow).
struct Patterns {
  std::regex number{"[0-9]+"};
  std::regex process{"(.*_)([0-9]+(?:,[0-9]+)+)()"};
  std::regex ready{"(MW for muCars )([0-9]+(?:, [0-9]+)+)( ready\\.)"};
};

const Patterns& patterns() {
  static const Patterns kPatterns;
  return kPatterns;
}

/// `begin` + number + `end` for each number of a list in the name, which `pattern` matches as
/// (begin)(list)(end); the name itself if it does not match.
std::vector<std::string> one_each(const std::string& name, const std::regex& pattern) {
  std::smatch parts;
  if (!std::regex_match(name, parts, pattern)) return {name};
  const std::string list = parts[2];
  std::vector<std::string> names;
  for (std::sregex_iterator number{list.begin(), list.end(), patterns().number}, end; number != end;
       ++number) {
    names.push_back(parts[1].str() + number->str() + parts[3].str());
  }
  return names;
}

}  // namespace

std::vector<std::string> process_names(const std::string& name) {
  return one_each(name, patterns().process);
}

std::vector<std::string> single_ready_ids(const std::string& source_id) {
  return one_each(source_id, patterns().ready);
}

}  // namespace hlc
