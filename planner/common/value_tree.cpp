#include "planner/common/value_tree.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "planner/common/yaml_text.hpp"

namespace hlc {
namespace {

/// Printing and freeing a value recurse to its depth.
constexpr std::size_t kDeepest = 100;
/// A value takes some 100 bytes, however short its text is, and aliases of YAML can multiply the
/// values of a short text.
constexpr std::size_t kMostValues = 4'000'000;
constexpr std::size_t kLongestPath = 200;
constexpr std::size_t kLongestShown = 60;

std::string quoted_json(const std::string& text) {
  using nlohmann::json;
  return json(text).dump(-1, ' ', false, json::error_handler_t::replace);
}

/// Appends the value as compact JSON, until the text is long enough to be cut.
void append_json(const Value& value, std::string& text) {
  if (text.size() > kLongestShown) return;
  switch (value.kind) {
    case Value::Kind::kList:
    case Value::Kind::kMap: {
      const bool is_map = value.kind == Value::Kind::kMap;
      text += is_map ? '{' : '[';
      for (std::size_t i = 0; i < value.values.size(); ++i) {
        if (i > 0) text += ',';
        if (is_map) text += quoted_json(value.keys[i]) + ":";
        append_json(value.values[i], text);
      }
      text += is_map ? '}' : ']';
      return;
    }
    case Value::Kind::kText:
      text += quoted_json(value.text);
      return;
    default:
      text += value.kind == Value::Kind::kNothing ? "null" : value.text;
  }
}

}  // namespace

std::string shown(const Value& value, FileFormat format) {
  if (format == FileFormat::kJson) {
    std::string text;
    append_json(value, text);
    return one_line(text, kLongestShown);
  }
  switch (value.kind) {
    case Value::Kind::kList:
      return "(a list)";
    case Value::Kind::kMap:
      return "(a map)";
    case Value::Kind::kNothing:
      return "(nothing)";
    default:
      return one_line(value.text, kLongestShown);
  }
}

std::string joined_path(const std::string& path, const std::string& key) {
  return (path.empty() ? "" : path + ".") + one_line(key);
}

std::string joined_path(const std::string& path, std::size_t index, FileFormat format) {
  return fmt::format("{}[{}]", path, format == FileFormat::kJson ? index : index + 1);
}

std::string file_and_line(const std::string& file, int line) {
  return line > 0 ? fmt::format("{}:{}: ", file, line) : file + ": ";
}

Value& ValueTreeBuilder::add(Value::Kind kind, int line) {
  if (++count_ > kMostValues) {
    throw std::invalid_argument(fmt::format("{}{}: too many values, must be <= {}",
                                            file_and_line(name_, line),
                                            one_line(path(), kLongestPath), kMostValues));
  }
  if (open_.empty()) {
    root_ = {.kind = kind, .line = line};
    return root_;
  }
  Value& parent = *open_.back();
  // The entry of a map was made with its key.
  if (parent.kind == Value::Kind::kList) parent.values.push_back({.line = line});
  Value& value = parent.values.back();
  value.kind = kind;
  return value;
}

void ValueTreeBuilder::key(std::string text, int line) {
  open_.back()->keys.push_back(std::move(text));
  open_.back()->values.push_back({.line = line});
  expects_key_ = false;
}

void ValueTreeBuilder::scalar(Value::Kind kind, std::string text, int line) {
  add(kind, line).text = std::move(text);
  expects_key_ = is_in_map();
}

void ValueTreeBuilder::open(Value::Kind kind, int line) {
  if (open_.size() == kDeepest) {
    throw std::invalid_argument(fmt::format("{}{}: too deeply nested, must be <= {} levels",
                                            file_and_line(name_, line),
                                            one_line(path(true), kLongestPath), kDeepest));
  }
  open_.push_back(&add(kind, line));
  expects_key_ = is_in_map();
}

void ValueTreeBuilder::close() {
  const Value& closed = *open_.back();
  open_.pop_back();
  expects_key_ = is_in_map();
  std::set<std::string_view> keys;
  for (std::size_t i = 0; i < closed.keys.size(); ++i) {
    if (keys.insert(closed.keys[i]).second) continue;
    throw std::invalid_argument(fmt::format(
        "{}{} = {}, duplicate key, must be unique", file_and_line(name_, closed.values[i].line),
        joined_path(path(false), closed.keys[i]), shown(closed.values[i], format_)));
  }
}

std::string ValueTreeBuilder::path(bool is_next) const {
  std::string path;
  for (const Value* one : open_) {
    if (one->kind == Value::Kind::kMap) {
      path = joined_path(path, one->keys.back());
    } else {
      const bool is_begun = one != open_.back() || !is_next;
      path = joined_path(path, one->values.size() - (is_begun ? 1 : 0), format_);
    }
  }
  return path;
}

std::vector<std::size_t> ValueTreeBuilder::place() const {
  std::vector<std::size_t> place;
  for (const Value* one : open_) {
    if (!one->values.empty()) place.push_back(one->values.size() - 1);
  }
  return place;
}

const Value& ValueTreeBuilder::at(const std::vector<std::size_t>& place) const {
  const Value* value = &root_;
  for (const std::size_t index : place) value = &value->values[index];
  return *value;
}

bool ValueTreeBuilder::is_open(const std::vector<std::size_t>& place) const {
  return std::ranges::find(open_, &at(place)) != open_.end();
}

}  // namespace hlc
