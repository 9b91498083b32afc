#include "hlc_bridge/dds/type_definition.hpp"

#include <set>
#include <sstream>

namespace hlc::dds {
namespace {

void append_file(const std::string& name, std::set<std::string>& done, std::string& text) {
  if (!done.insert(name).second) return;
  std::istringstream lines(idl_files().at(name));
  std::string own;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("#include")) {
      const std::size_t begin = line.find('"') + 1;
      append_file(line.substr(begin, line.rfind('"') - begin), done, text);
    } else if (!line.starts_with('#')) {
      own += line + "\n";
    }
  }
  text += own;
}

}  // namespace

std::string type_definition(const std::string& type) {
  const std::size_t scope = type.rfind(':');
  std::string text;
  std::set<std::string> done;
  append_file(type.substr(scope == std::string::npos ? 0 : scope + 1) + ".idl", done, text);
  return text;
}

}  // namespace hlc::dds
