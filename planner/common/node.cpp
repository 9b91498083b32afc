#include "planner/common/node.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <type_traits>

#include "planner/common/text_file.hpp"
#include "planner/common/yaml_text.hpp"

namespace hlc {
namespace {

std::string joined(const std::vector<std::string>& words) {
  std::vector<std::string> shown;
  for (const std::string& word : words) shown.push_back(one_line(word));
  return fmt::format("{}", fmt::join(shown, ", "));
}

template <typename T>
std::string type_name() {
  if constexpr (std::is_same_v<T, bool>) {
    return "true or false";
  } else if constexpr (std::is_same_v<T, std::string>) {
    return "text";
  } else if constexpr (std::is_integral_v<T>) {
    return "a whole number";
  } else {
    return "a number";
  }
}

template <typename T>
std::string description(const Allowed& allowed) {
  if (!allowed.words.empty()) {
    return (allowed.words.size() > 1 ? "one of " : "") + joined(allowed.words);
  }
  std::string text = type_name<T>();
  const bool has_min = std::isfinite(allowed.min);
  const bool has_max = std::isfinite(allowed.max);
  if (has_min) {
    text += (allowed.min_excluded ? " > " : " >= ") + fmt::format("{:g}", allowed.min);
  } else if (std::is_unsigned_v<T> && !std::is_same_v<T, bool>) {
    text += " >= 0";
  }
  if (has_max) {
    text += std::string(has_min ? " and" : "") + " <= " + fmt::format("{:g}", allowed.max);
  }
  return text;
}

template <typename T>
std::optional<T> converted(const std::string& text) {
  if constexpr (std::is_same_v<T, std::string>) {
    return text;
  } else if constexpr (std::is_same_v<T, bool>) {
    if (text != "true" && text != "false") {
      return std::nullopt;
    }
    return text == "true";
  } else {
    T value{};
    const char* const end = text.data() + text.size();
    const auto [rest, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc{} || rest != end) {
      return std::nullopt;
    }
    return value;
  }
}

bool is_single(const Value& value) {
  return value.kind == Value::Kind::kScalar || value.kind == Value::Kind::kText ||
         value.kind == Value::Kind::kLiteral;
}

template <typename T>
bool is_allowed(const T& value, const Allowed& allowed) {
  if constexpr (std::is_same_v<T, std::string>) {
    return allowed.words.empty() ||
           std::find(allowed.words.begin(), allowed.words.end(), value) != allowed.words.end();
  } else if constexpr (std::is_same_v<T, bool>) {
    return true;
  } else {
    const double x = static_cast<double>(value);
    return std::isfinite(x) && x <= allowed.max &&
           (allowed.min_excluded ? x > allowed.min : x >= allowed.min);
  }
}

}  // namespace

Allowed above(double min, double max) {
  Allowed allowed;
  allowed.min = min;
  allowed.max = max;
  allowed.min_excluded = true;
  return allowed;
}

Allowed at_least(double min) {
  Allowed allowed;
  allowed.min = min;
  return allowed;
}

Allowed between(double min, double max) {
  Allowed allowed;
  allowed.min = min;
  allowed.max = max;
  return allowed;
}

Allowed one_of(std::vector<std::string> words) {
  Allowed allowed;
  allowed.words = std::move(words);
  return allowed;
}

struct Node::File {
  std::string name;
  FileFormat format{};
  Value root;
};

Node::Node(std::shared_ptr<const File> file, const Value& value, std::string path, int line)
    : file_(std::move(file)),
      value_(&value),
      path_(std::move(path)),
      line_(line),
      asked_(std::make_shared<std::vector<std::string>>()) {}

Node Node::root_of(Value root, const std::string& name, FileFormat format) {
  auto file = std::make_shared<const File>(File{name, format, std::move(root)});
  const Value& value = file->root;
  Node node(std::move(file), value, "", value.line);
  if (!node.is_map()) node.fail(node.map_word());
  return node;
}

Node Node::read_yaml(const std::filesystem::path& path) {
  return parse_yaml(read_regular_file(path, "a YAML file"), path.string());
}

Node Node::parse_yaml(const std::string& text, const std::string& name) {
  return root_of(hlc::parse_yaml(text, name), name, FileFormat::kYaml);
}

Node Node::read_json(const std::filesystem::path& path) {
  std::istringstream stream(read_regular_file(path, "a JSON file"));
  return root_of(parse_json(stream, path.string()), path.string(), FileFormat::kJson);
}

bool Node::is_value(const std::string& key) const {
  const std::optional<Node> found = find(key);
  return found && is_single(*found->value_);
}

bool Node::is_list(const std::string& key) const {
  const std::optional<Node> found = find(key);
  return found && found->is_list();
}

template <typename T>
T Node::required(const std::string& key, const Allowed& allowed) const {
  const Node found = child(key, description<T>(allowed));
  return found.as<T>(allowed);
}

template <typename T>
T Node::optional(const std::string& key, T fallback, const Allowed& allowed) const {
  return has(key) ? required<T>(key, allowed) : fallback;
}

Node Node::map(const std::string& key) const {
  Node found = child(key, map_word());
  if (!found.is_map()) found.fail(map_word());
  return found;
}

Node Node::optional_map(const std::string& key) const {
  static const Value kNoKeys{.kind = Value::Kind::kMap};
  return has(key) ? map(key) : Node(file_, kNoKeys, joined_path(path_, key), line_);
}

std::vector<Node> Node::list(const std::string& key) const {
  return child(key, "a list").entries();
}

std::vector<Node> Node::optional_list(const std::string& key) const {
  return has(key) ? list(key) : std::vector<Node>{};
}

std::vector<Node> Node::list(const std::string& key, std::size_t count,
                             const std::string& allowed) const {
  return child(key, allowed).entries(count, allowed);
}

std::vector<Node> Node::optional_list(const std::string& key, std::size_t count,
                                      const std::string& allowed) const {
  return has(key) ? list(key, count, allowed) : std::vector<Node>{};
}

template <typename T>
T Node::as(const Allowed& allowed) const {
  constexpr auto kOtherFormats =
      std::is_same_v<T, std::string> ? Value::Kind::kText : Value::Kind::kLiteral;
  if (value_->kind == Value::Kind::kScalar || value_->kind == kOtherFormats) {
    const std::optional<T> value = converted<T>(value_->text);
    if (value && is_allowed(*value, allowed)) return *value;
  }
  fail(description<T>(allowed));
}

std::vector<Node> Node::entries() const {
  if (!is_list()) fail("a list");
  std::vector<Node> result;
  for (const Value& entry : value_->values) {
    result.push_back(
        Node(file_, entry, joined_path(path_, result.size(), file_->format), entry.line));
  }
  return result;
}

std::vector<Node> Node::entries(std::size_t count, const std::string& allowed) const {
  if (!is_list()) fail(allowed);
  if (value_->values.size() != count) {
    fail_at(line_,
            fmt::format("{} has {} entries, must have {}", path_, value_->values.size(), allowed));
  }
  return entries();
}

std::vector<std::string> Node::keys() const { return value_->keys; }

void Node::check_keys(std::initializer_list<const char*> known) const {
  for (const char* key : known) static_cast<void>(has(key));
  check_no_unknown_keys();
}

void Node::check_no_unknown_keys() const {
  for (std::size_t i = 0; i < value_->keys.size(); ++i) {
    const std::string& key = value_->keys[i];
    if (std::ranges::find(*asked_, key) != asked_->end()) continue;
    const Value& value = value_->values[i];
    fail_at(value.line, fmt::format("{} = {}, unknown key; known keys: {}", joined_path(path_, key),
                                    shown(value, file_->format), joined(*asked_)));
  }
}

std::string Node::place(const std::string& key) const {
  const std::optional<Node> found = find(key);
  return file_and_line(file_->name, found ? found->line_ : line_) + joined_path(path_, key) +
         (found ? " = " + found->shown_value() : "");
}

void Node::fail(const std::string& key, const std::string& allowed) const {
  child(key, allowed).fail(allowed);
}

void Node::fail(const std::string& allowed) const {
  fail_at(line_, fmt::format("{}{}{}, must be {}", path_, path_.empty() ? "" : " = ", shown_value(),
                             allowed));
}

bool Node::has(const std::string& key) const { return find(key).has_value(); }

std::optional<Node> Node::find(const std::string& key) const {
  if (!is_map()) fail(map_word());
  if (std::ranges::find(*asked_, key) == asked_->end()) asked_->push_back(key);
  const auto found = std::ranges::find(value_->keys, key);
  if (found == value_->keys.end()) return std::nullopt;
  const Value& value = value_->values[static_cast<std::size_t>(found - value_->keys.begin())];
  return Node(file_, value, joined_path(path_, key), value.line);
}

Node Node::child(const std::string& key, const std::string& allowed) const {
  const std::optional<Node> found = find(key);
  if (!found) fail_at(line_, joined_path(path_, key) + " is missing, must be " + allowed);
  return *found;
}

void Node::fail_at(int line, const std::string& text) const {
  throw std::invalid_argument(file_and_line(file_->name, line) + text);
}

std::string Node::shown_value() const { return shown(*value_, file_->format); }

std::string Node::map_word() const {
  return file_->format == FileFormat::kJson ? "an object" : "a map (key: value)";
}

#define HLC_NODE_TYPE(T)                                                     \
  template T Node::required<T>(const std::string&, const Allowed&) const;    \
  template T Node::optional<T>(const std::string&, T, const Allowed&) const; \
  template T Node::as<T>(const Allowed&) const
HLC_NODE_TYPE(double);
HLC_NODE_TYPE(int);
HLC_NODE_TYPE(std::size_t);
HLC_NODE_TYPE(bool);
HLC_NODE_TYPE(std::string);
#undef HLC_NODE_TYPE

}  // namespace hlc
