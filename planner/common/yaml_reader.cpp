#include "planner/common/yaml_reader.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <type_traits>

#include "planner/common/yaml_text.hpp"

namespace hlc {
namespace {

std::string printed(double value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) {
    text += (text.empty() ? "" : ", ") + one_line(word);
  }
  return text;
}

/// A key as it stands in the file.
std::string key_of(const YAML::Node& node) { return node.IsScalar() ? node.Scalar() : "(no text)"; }

/// A value as messages show it.
std::string printed(const YAML::Node& node) {
  switch (node.Type()) {
    case YAML::NodeType::Scalar:
      return one_line(node.Scalar());
    case YAML::NodeType::Sequence:
      return "(a list)";
    case YAML::NodeType::Map:
      return "(a map)";
    default:
      return "(nothing)";
  }
}

/// The first line of a text: messages are one line.
std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

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
    return joined(allowed.words);
  }
  std::string text = type_name<T>();
  const bool has_min = std::isfinite(allowed.min);
  const bool has_max = std::isfinite(allowed.max);
  if (has_min) {
    text += (allowed.min_excluded ? " > " : " >= ") + printed(allowed.min);
  } else if (std::is_unsigned_v<T> && !std::is_same_v<T, bool>) {
    text += " >= 0";
  }
  if (has_max) {
    text += std::string(has_min ? " and" : "") + " <= " + printed(allowed.max);
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

YamlNode::YamlNode(const YAML::Node& node, std::string file, std::string path, int line)
    : node_(node),
      file_(std::move(file)),
      path_(std::move(path)),
      line_(line),
      asked_(std::make_shared<std::vector<std::string>>()) {
  if (!node_.IsMap()) {
    return;
  }
  // YAML libraries let a repeated key pass; only one of the two would count.
  std::vector<std::string> keys;
  for (const auto& entry : node_) {
    const std::string key = key_of(entry.first);
    if (std::find(keys.begin(), keys.end(), key) != keys.end()) {
      fail_at(entry.first.Mark().line + 1, path_of(key) + " = " + printed(entry.second) +
                                               ", allowed once; the key is there twice");
    }
    keys.push_back(key);
  }
}

YamlNode YamlNode::read_file(const std::filesystem::path& path) {
  // A device may have no end.
  std::error_code error;
  std::ifstream file;
  if (std::filesystem::is_regular_file(path, error)) file.open(path);
  std::stringstream text;
  text << file.rdbuf();
  if (!file.is_open() || file.bad()) {
    throw std::invalid_argument(path.string() + ": cannot be read, allowed a YAML file");
  }
  return parse(text.str(), path.string());
}

YamlNode YamlNode::parse(const std::string& text, const std::string& name) {
  YAML::Node node;
  try {
    node = YAML::Load(text);
  } catch (const YAML::Exception& error) {
    throw std::invalid_argument(name + ":" + std::to_string(error.mark.line + 1) +
                                ": not YAML: " + first_line(error.msg));
  }
  if (!node.IsMap()) {
    throw std::invalid_argument(name + ":1: " + printed(node) + ", allowed a map (key: value)");
  }
  return {node, name, "", 1};
}

bool YamlNode::is_value(const std::string& key) const {
  const std::optional<YamlNode> found = find(key);
  return found && found->node_.IsScalar();
}

bool YamlNode::is_list(const std::string& key) const {
  const std::optional<YamlNode> found = find(key);
  return found && found->node_.IsSequence();
}

template <typename T>
T YamlNode::required(const std::string& key, const Allowed& allowed) const {
  const YamlNode found = child(key, description<T>(allowed));
  return found.as<T>(allowed);
}

template <typename T>
T YamlNode::optional(const std::string& key, T fallback, const Allowed& allowed) const {
  return has(key) ? required<T>(key, allowed) : fallback;
}

YamlNode YamlNode::map(const std::string& key) const {
  YamlNode found = child(key, "a map (key: value)");
  if (!found.node_.IsMap()) {
    found.fail("a map (key: value)");
  }
  return found;
}

YamlNode YamlNode::optional_map(const std::string& key) const {
  return has(key) ? map(key)
                  : YamlNode(YAML::Node(YAML::NodeType::Map), file_, path_of(key), line_);
}

std::vector<YamlNode> YamlNode::list(const std::string& key) const {
  return child(key, "a list").entries();
}

std::vector<YamlNode> YamlNode::optional_list(const std::string& key) const {
  return has(key) ? list(key) : std::vector<YamlNode>{};
}

template <typename T>
T YamlNode::as(const Allowed& allowed) const {
  if (node_.IsScalar()) {
    const std::optional<T> value = converted<T>(node_.Scalar());
    if (value && is_allowed(*value, allowed)) {
      return *value;
    }
  }
  fail(description<T>(allowed));
}

std::vector<YamlNode> YamlNode::entries() const {
  if (!node_.IsSequence()) {
    fail("a list");
  }
  std::vector<YamlNode> result;
  for (const auto& entry : node_) {
    result.push_back(YamlNode(entry, file_, path_ + "[" + std::to_string(result.size() + 1) + "]",
                              entry.Mark().line + 1));
  }
  return result;
}

std::vector<std::string> YamlNode::keys() const {
  std::vector<std::string> result;
  for (const auto& entry : node_) result.push_back(key_of(entry.first));
  return result;
}

void YamlNode::check_no_unknown_keys() const {
  for (const auto& entry : node_) {
    const std::string key = key_of(entry.first);
    if (std::find(asked_->begin(), asked_->end(), key) == asked_->end()) {
      fail_at(entry.first.Mark().line + 1, path_of(key) + " = " + printed(entry.second) +
                                               ", unknown key, allowed keys " + joined(*asked_));
    }
  }
}

std::string YamlNode::place(const std::string& key) const {
  const std::optional<YamlNode> found = find(key);
  return file_ + ":" + std::to_string(found ? found->line_ : line_) + ": " + path_of(key) +
         (found ? " = " + printed(found->node_) : "");
}

void YamlNode::fail(const std::string& key, const std::string& allowed) const {
  child(key, allowed).fail(allowed);
}

void YamlNode::fail(const std::string& allowed) const {
  fail_at(line_, path_ + " = " + printed(node_) + ", allowed " + allowed);
}

bool YamlNode::has(const std::string& key) const { return find(key).has_value(); }

std::optional<YamlNode> YamlNode::find(const std::string& key) const {
  if (!node_.IsMap()) {
    fail("a map (key: value)");
  }
  if (std::find(asked_->begin(), asked_->end(), key) == asked_->end()) {
    asked_->push_back(key);
  }
  for (const auto& entry : node_) {
    if (key_of(entry.first) == key) {
      // The key's line: a value that is left out has no place of its own.
      return YamlNode(entry.second, file_, path_of(key), entry.first.Mark().line + 1);
    }
  }
  return std::nullopt;
}

YamlNode YamlNode::child(const std::string& key, const std::string& allowed) const {
  const std::optional<YamlNode> found = find(key);
  if (!found) {
    fail_at(line_, path_of(key) + " is missing, allowed " + allowed);
  }
  return *found;
}

void YamlNode::fail_at(int line, const std::string& text) const {
  throw std::invalid_argument(file_ + ":" + std::to_string(line) + ": " + text);
}

std::string YamlNode::path_of(const std::string& key) const {
  return (path_.empty() ? "" : path_ + ".") + one_line(key);
}

#define HLC_YAML_TYPE(T)                                                         \
  template T YamlNode::required<T>(const std::string&, const Allowed&) const;    \
  template T YamlNode::optional<T>(const std::string&, T, const Allowed&) const; \
  template T YamlNode::as<T>(const Allowed&) const
HLC_YAML_TYPE(double);
HLC_YAML_TYPE(int);
HLC_YAML_TYPE(std::size_t);
HLC_YAML_TYPE(bool);
HLC_YAML_TYPE(std::string);
#undef HLC_YAML_TYPE

}  // namespace hlc
