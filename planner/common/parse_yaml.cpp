#include <fmt/format.h>
#include <yaml-cpp/anchor.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>

#include <map>
#include <sstream>
#include <stdexcept>

#include "planner/common/value_tree.hpp"

namespace hlc {
namespace {

constexpr char kNoText[] = "(no text)";  // stands for a key that is a list, a map or nothing

/// Events of yaml-cpp's parser. Its own tree takes several times as much memory as ours.
class YamlEvents : public YAML::EventHandler {
 public:
  explicit YamlEvents(const std::string& name) : name_(name), tree_(name, FileFormat::kYaml) {}

  void OnDocumentStart(const YAML::Mark& /*mark*/) override {}
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    scalar({.kind = Value::Kind::kNothing, .line = mark.line + 1}, anchor);
  }
  void OnScalar(const YAML::Mark& mark, const std::string& /*tag*/, YAML::anchor_t anchor,
                const std::string& text) override {
    scalar({.kind = Value::Kind::kScalar, .line = mark.line + 1, .text = text}, anchor);
  }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    if (depth_in_key_ > 0) return;
    if (const auto key = keys_.find(anchor); key != keys_.end()) return scalar(key->second, 0);
    const auto place = places_.find(anchor);
    if (place == places_.end() || tree_.is_open(place->second)) {
      throw std::invalid_argument(
          fmt::format("{}{}: an alias of a value that holds it, must be of an earlier value",
                      file_and_line(name_, mark.line + 1), tree_.path()));
    }
    const Value value = tree_.at(place->second);  // a copy: the tree grows
    repeat(value);
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string& /*tag*/, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value /*style*/) override {
    open(Value::Kind::kList, mark.line + 1, anchor);
  }
  void OnSequenceEnd() override { close(); }
  void OnMapStart(const YAML::Mark& mark, const std::string& /*tag*/, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value /*style*/) override {
    open(Value::Kind::kMap, mark.line + 1, anchor);
  }
  void OnMapEnd() override { close(); }

  [[nodiscard]] Value take() { return tree_.take(); }

 private:
  void scalar(const Value& value, YAML::anchor_t anchor) {
    if (depth_in_key_ > 0) return;
    if (tree_.expects_key()) {
      tree_.key(value.kind == Value::Kind::kScalar ? value.text : kNoText, value.line);
      if (anchor != 0) keys_[anchor] = value;
      return;
    }
    tree_.scalar(value.kind, value.text, value.line);
    remember(anchor);
  }
  void open(Value::Kind kind, int line, YAML::anchor_t anchor) {
    if (depth_in_key_ > 0 || tree_.expects_key()) {
      if (++depth_in_key_ == 1) tree_.key(kNoText, line);
      return;
    }
    tree_.open(kind, line);
    remember(anchor);
  }
  void close() { depth_in_key_ > 0 ? void(--depth_in_key_) : tree_.close(); }
  void remember(YAML::anchor_t anchor) {
    if (anchor != 0) places_[anchor] = tree_.place();
  }
  void repeat(const Value& value) {
    if (value.kind != Value::Kind::kList && value.kind != Value::Kind::kMap) {
      return scalar(value, 0);
    }
    open(value.kind, value.line, 0);
    if (depth_in_key_ == 0) {
      for (std::size_t i = 0; i < value.values.size(); ++i) {
        if (value.kind == Value::Kind::kMap) tree_.key(value.keys[i], value.values[i].line);
        repeat(value.values[i]);
      }
    }
    close();
  }

  const std::string& name_;
  ValueTreeBuilder tree_;
  std::size_t depth_in_key_{};  ///< of lists and maps that are a key, of which nothing is kept
  std::map<YAML::anchor_t, std::vector<std::size_t>> places_;
  std::map<YAML::anchor_t, Value> keys_;
};

}  // namespace

Value parse_yaml(const std::string& text, const std::string& name) {
  YamlEvents events(name);
  std::istringstream stream(text);
  try {
    if (!YAML::Parser(stream).HandleNextDocument(events)) return {.line = 1};
  } catch (const YAML::Exception& error) {
    const std::string first_line = error.msg.substr(0, error.msg.find('\n'));  // messages are one
    throw std::invalid_argument(
        fmt::format("{}:{}: not YAML: {}", name, error.mark.line + 1, first_line));
  }
  Value root = events.take();
  root.line = 1;
  return root;
}

}  // namespace hlc
