#include "vehicle_sim/python/module/changed_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>

#include "hlc_bridge/record/configuration.hpp"
#include "planner/common/text_file.hpp"
#include "planner/common/value_tree.hpp"
#include "planner/common/yaml_text.hpp"

namespace hlc::python {
namespace {

constexpr std::array<std::string_view, 3> kFileKeys{"automaton", "lab", "map"};

Value value_of(const py::handle& object, const std::string& path);

Value map_of(const py::dict& dict, const std::string& path) {
  Value map{.kind = Value::Kind::kMap};
  for (const auto& [key, one] : dict) {
    const std::string name = py::str(key);
    map.keys.push_back(name);
    map.values.push_back(value_of(one, joined_path(path, name)));
  }
  return map;
}

Value value_of(const py::handle& object, const std::string& path) {
  if (py::isinstance<py::dict>(object)) return map_of(py::cast<py::dict>(object), path);
  if (py::isinstance<py::list>(object) || py::isinstance<py::tuple>(object)) {
    Value list{.kind = Value::Kind::kList};
    for (const py::handle& one : object) {
      list.values.push_back(
          value_of(one, joined_path(path, list.values.size(), FileFormat::kYaml)));
    }
    return list;
  }
  Value scalar{.kind = Value::Kind::kScalar};
  if (py::isinstance<py::bool_>(object)) {
    scalar.text = py::cast<bool>(object) ? "true" : "false";
  } else if (py::isinstance<py::str>(object)) {
    scalar.text = py::cast<std::string>(object);
  } else if (PyIndex_Check(object.ptr()) != 0) {
    scalar.text = py::str(py::reinterpret_steal<py::object>(PyNumber_Index(object.ptr())));
  } else if (PyFloat_Check(object.ptr())) {
    scalar.text = shortest_text(py::cast<double>(object));
  } else {
    throw std::invalid_argument(
        fmt::format("values: {} = {}, must be str, bool, int, float, list "
                    "or dict",
                    path, one_line(py::cast<std::string>(py::repr(object)))));
  }
  return scalar;
}

void change(Value& map, const py::dict& changes, const std::string& path) {
  for (const auto& [key, one] : changes) {
    const std::string name = py::str(key);
    const auto found = std::ranges::find(map.keys, name);
    const auto index = found - map.keys.begin();
    if (one.is_none()) {
      if (found == map.keys.end()) continue;
      map.keys.erase(found);
      map.values.erase(map.values.begin() + index);
    } else if (found == map.keys.end()) {
      map.keys.push_back(name);
      map.values.push_back(value_of(one, joined_path(path, name)));
    } else if (Value& value = map.values[static_cast<std::size_t>(index)];
               value.kind == Value::Kind::kMap && py::isinstance<py::dict>(one)) {
      change(value, py::cast<py::dict>(one), joined_path(path, name));
    } else {
      const int line = value.line;
      value = value_of(one, joined_path(path, name));
      value.line = line;
    }
  }
}

/// Writes a tree in YAML's flow style, each value in its own line of the file where it can.
class FlowText {
 public:
  void add(const Value& value) {
    begin_line(value.line);
    switch (value.kind) {
      case Value::Kind::kMap:
        text_ += '{';
        for (std::size_t i = 0; i < value.keys.size(); ++i) {
          begin_line(value.values[i].line);
          text_ += quoted_yaml(value.keys[i]) + ": ";
          add(value.values[i]);
          text_ += ", ";
        }
        text_ += '}';
        break;
      case Value::Kind::kList:
        text_ += '[';
        for (const Value& one : value.values) {
          add(one);
          text_ += ", ";
        }
        text_ += ']';
        break;
      case Value::Kind::kNothing:
        text_ += '~';
        break;
      default:
        text_ += quoted_yaml(value.text);
    }
  }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  void begin_line(int line) {
    for (; line_ < line; ++line_) text_ += '\n';
  }

  std::string text_;
  int line_{1};
};

Value changed(const std::filesystem::path& file, const py::dict& changes) {
  Value root = parse_yaml(read_regular_file(file, "a YAML file"), file.string());
  change(root, changes, "");
  return root;
}

std::string text_of(const Value& root) {
  FlowText flow;
  flow.add(root);
  return flow.text() + '\n';
}

/// Names the file that a value of the map names by the place of its copy.
void name_copy(Value& map, std::string_view key, const std::filesystem::path& folder) {
  for (std::size_t i = 0; i < map.keys.size(); ++i) {
    Value& value = map.values[i];
    if (map.keys[i] != key || value.kind != Value::Kind::kScalar) continue;
    // An absolute path is itself.
    value.text = record::path_between_kept(folder / value.text).string();
  }
}

}  // namespace

Node read_with_changes(const std::filesystem::path& file, const py::dict& changes) {
  Node as_it_is = Node::read_yaml(file);
  if (changes.empty()) return as_it_is;
  return Node::parse_yaml(text_of(changed(file, changes)), file.string());
}

std::string text_with_changes(const std::filesystem::path& file, const py::dict& changes) {
  Value root = changed(file, changes);
  const std::filesystem::path folder = std::filesystem::absolute(file).parent_path();
  for (const std::string_view key : kFileKeys) name_copy(root, key, folder);
  for (std::size_t i = 0; i < root.keys.size(); ++i) {
    if (root.keys[i] != "guests") continue;
    for (Value& guest : root.values[i].values) name_copy(guest, "track", folder);
  }
  return text_of(root);
}

}  // namespace hlc::python
