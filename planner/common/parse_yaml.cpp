#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <stdexcept>

#include "planner/common/value_tree.hpp"

namespace hlc {
namespace {

void add(const YAML::Node& node, int line, ValueTreeBuilder& tree) {
  switch (node.Type()) {
    case YAML::NodeType::Scalar:
      tree.scalar(Value::Kind::kScalar, node.Scalar(), line);
      return;
    case YAML::NodeType::Sequence:
      tree.open(Value::Kind::kList, line);
      for (const auto& entry : node) add(entry, entry.Mark().line + 1, tree);
      tree.close();
      return;
    case YAML::NodeType::Map:
      tree.open(Value::Kind::kMap, line);
      for (const auto& entry : node) {
        // The key's line: an omitted value has no place of its own.
        const int key_line = entry.first.Mark().line + 1;
        tree.key(entry.first.IsScalar() ? entry.first.Scalar() : "(no text)", key_line);
        add(entry.second, key_line, tree);
      }
      tree.close();
      return;
    default:
      tree.scalar(Value::Kind::kNothing, {}, line);
  }
}

}  // namespace

Value parse_yaml(const std::string& text, const std::string& name) {
  ValueTreeBuilder tree(name, FileFormat::kYaml);
  try {
    add(YAML::Load(text), 1, tree);
  } catch (const YAML::Exception& error) {
    const std::string first_line = error.msg.substr(0, error.msg.find('\n'));  // messages are one
    throw std::invalid_argument(
        fmt::format("{}:{}: not YAML: {}", name, error.mark.line + 1, first_line));
  }
  return tree.take();
}

}  // namespace hlc
