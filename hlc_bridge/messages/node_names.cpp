#include "hlc_bridge/messages/node_names.hpp"

#include <regex>

namespace hlc {
namespace {

/// `begin` + number + `end` for each number of a list in the name, which `pattern` matches as
/// (begin)(list)(end); the name itself if it does not match.
std::vector<std::string> one_each(const std::string& name, const std::regex& pattern) {
  std::smatch parts;
  if (!std::regex_match(name, parts, pattern)) return {name};
  static const std::regex kNumber{"[0-9]+"};
  const std::string list = parts[2];
  std::vector<std::string> names;
  for (std::sregex_iterator number{list.begin(), list.end(), kNumber}, end; number != end;
       ++number) {
    names.push_back(parts[1].str() + number->str() + parts[3].str());
  }
  return names;
}

}  // namespace

std::vector<std::string> process_names(const std::string& name) {
  static const std::regex kShared{"(.*_)([0-9]+(?:,[0-9]+)+)()"};
  return one_each(name, kShared);
}

std::vector<std::string> single_ready_ids(const std::string& source_id) {
  static const std::regex kShared{"(MW for muCars )([0-9]+(?:, [0-9]+)+)( ready\\.)"};
  return one_each(source_id, kShared);
}

}  // namespace hlc
