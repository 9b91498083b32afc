#pragma once

#include <cstddef>
#include <iosfwd>
#include <string>
#include <utility>
#include <vector>

namespace hlc {

/// The content of a YAML or JSON file, in the order of the file and without interpretation.
struct Value {
  enum class Kind {
    kNothing,
    kScalar,   ///< of YAML: its reader decides whether it is text, a number or a truth value
    kText,     ///< of JSON
    kLiteral,  ///< of JSON: a number or a truth value
    kList,
    kMap,
  };
  Kind kind{Kind::kNothing};
  int line{};                       ///< from 1, of a map's entry that of its key; 0: not known
  std::string text{};               ///< of a scalar, text or literal
  std::vector<std::string> keys{};  ///< of a map, as many as `values`, all different
  std::vector<Value> values{};      ///< of a list or map
};

enum class FileFormat { kYaml, kJson };

/// Parses a text; `name` stands for the file in messages. Anchors of YAML are resolved.
/// @throws std::invalid_argument with one line, "name:line: ..." (YAML) or "name: ..." (JSON), if
/// the text is not of that format, holds a number beyond a double (JSON), a key twice in one map,
/// more than 100 lists and maps within each other or more than 4 million values
[[nodiscard]] Value parse_yaml(const std::string& text, const std::string& name);
[[nodiscard]] Value parse_json(std::istream& stream, const std::string& name);

/// The value as shown in messages: one short line.
[[nodiscard]] std::string shown(const Value& value, FileFormat format);

/// "limits" and "speed" -> "limits.speed"; "wheels" and the first entry -> "wheels[1]" (YAML) or
/// "wheels[0]" (JSON, as programs count).
[[nodiscard]] std::string joined_path(const std::string& path, const std::string& key);
[[nodiscard]] std::string joined_path(const std::string& path, std::size_t index,
                                      FileFormat format);
/// "car.yaml:3: ", or "car.json: " if the line is unknown.
[[nodiscard]] std::string file_and_line(const std::string& file, int line);

/// Builds the tree from a parser's events, and throws as stated for the functions above.
class ValueTreeBuilder {
 public:
  ValueTreeBuilder(std::string name, FileFormat format) : name_(std::move(name)), format_(format) {}

  /// The key of the next value of the open map.
  void key(std::string text, int line);
  void scalar(Value::Kind kind, std::string text, int line);
  void open(Value::Kind kind, int line);  ///< a list or map
  void close();

  /// Place of the next value (or of the one begun last), "limits.speed"; empty at the top.
  [[nodiscard]] std::string path(bool is_next = true) const;
  /// True if the open value is a map whose last key has its value.
  [[nodiscard]] bool expects_key() const { return expects_key_; }
  /// Indices of the value that was begun last among those of each list or map that holds it.
  [[nodiscard]] std::vector<std::size_t> place() const;
  /// The value there; valid until the next one is added.
  [[nodiscard]] const Value& at(const std::vector<std::size_t>& place) const;
  [[nodiscard]] bool is_open(const std::vector<std::size_t>& place) const;
  /// @pre every opened list or map is closed
  [[nodiscard]] Value take() { return std::move(root_); }

 private:
  Value& add(Value::Kind kind, int line);
  [[nodiscard]] bool is_in_map() const {
    return !open_.empty() && open_.back()->kind == Value::Kind::kMap;
  }

  std::string name_;
  FileFormat format_;
  Value root_;
  std::vector<Value*> open_;  ///< a list or map stays in place while it is open
  std::size_t count_{};
  bool expects_key_{false};
};

}  // namespace hlc
