#pragma once

#include <filesystem>
#include <initializer_list>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "planner/common/value_tree.hpp"

namespace hlc {

/// Bounds of a field beside its type: a range for numbers, a choice of words for strings.
struct Allowed {
  double min{-std::numeric_limits<double>::infinity()};
  double max{std::numeric_limits<double>::infinity()};
  bool min_excluded{false};
  std::vector<std::string> words;  ///< empty: any
};

/// min < x <= max
[[nodiscard]] Allowed above(double min, double max = std::numeric_limits<double>::infinity());
[[nodiscard]] Allowed at_least(double min);             ///< x >= min
[[nodiscard]] Allowed between(double min, double max);  ///< min <= x <= max
[[nodiscard]] Allowed one_of(std::vector<std::string> words);

/// A map, list or value of a YAML or JSON file that knows its place, for strict reading: every
/// field has a type and a range, and a key that was not read is an error.
///
///     const Node file = Node::read_yaml("car.yaml");
///     const auto length_m = file.required<double>("length_m", above(0.0));
///     const auto name = file.optional<std::string>("name", "car");
///     for (const Node& wheel : file.list("wheels")) {
///       radii_m.push_back(wheel.required<double>("radius_m"));
///       wheel.check_no_unknown_keys();
///     }
///     file.check_no_unknown_keys();  // for every map, after its last field
///
/// All errors are std::invalid_argument with one line, "file:line: key = value, must be ...", for
/// JSON without the line. Keys are printed with their path, list entries counted from 1 in YAML,
/// `trims[3].speed_mps`, and from 0 in JSON. Long values are cut. Copies are cheap: all nodes of a
/// file share it.
class Node {
 public:
  /// @throws std::invalid_argument if the file is no regular file, cannot be read, is not YAML (see
  /// parse_yaml), or does not hold a map
  [[nodiscard]] static Node read_yaml(const std::filesystem::path& path);
  /// The same for text in memory; `name` is the file's name in messages.
  [[nodiscard]] static Node parse_yaml(const std::string& text, const std::string& name);
  /// The same for JSON (see parse_json); need not be a regular file.
  [[nodiscard]] static Node read_json(const std::filesystem::path& path);

  [[nodiscard]] bool has(const std::string& key) const;

  /// True if the key exists and holds a single value, neither a map nor a list.
  [[nodiscard]] bool is_value(const std::string& key) const;

  /// True if the key exists and holds a list.
  [[nodiscard]] bool is_list(const std::string& key) const;

  /// Value of a key of this map. T: double (finite), int, std::size_t, bool, std::string.
  template <typename T>
  [[nodiscard]] T required(const std::string& key, const Allowed& allowed = {}) const;
  /// The same, `fallback` if the key is absent. `fallback` itself is not checked.
  template <typename T>
  [[nodiscard]] T optional(const std::string& key, T fallback, const Allowed& allowed = {}) const;

  /// A map inside this map.
  [[nodiscard]] Node map(const std::string& key) const;
  /// The same; a map without keys if the key is absent.
  [[nodiscard]] Node optional_map(const std::string& key) const;
  /// Entries of a list inside this map; may be empty.
  [[nodiscard]] std::vector<Node> list(const std::string& key) const;
  /// The same of a list with exactly `count` entries; `allowed` describes it in messages.
  [[nodiscard]] std::vector<Node> list(const std::string& key, std::size_t count,
                                       const std::string& allowed) const;
  /// The same; no entries if the key is absent.
  [[nodiscard]] std::vector<Node> optional_list(const std::string& key) const;
  [[nodiscard]] std::vector<Node> optional_list(const std::string& key, std::size_t count,
                                                const std::string& allowed) const;

  /// The keys of this map, in their order in the file.
  [[nodiscard]] std::vector<std::string> keys() const;

  /// True if this entry of a list is a map, a list.
  [[nodiscard]] bool is_map() const { return value_->kind == Value::Kind::kMap; }
  [[nodiscard]] bool is_list() const { return value_->kind == Value::Kind::kList; }
  /// Value of an entry of a list. T as for `required`.
  template <typename T>
  [[nodiscard]] T as(const Allowed& allowed = {}) const;
  /// Entries of an entry that is itself a list.
  [[nodiscard]] std::vector<Node> entries() const;
  /// The same of a list with exactly `count` entries; `allowed` describes it in messages.
  [[nodiscard]] std::vector<Node> entries(std::size_t count, const std::string& allowed) const;

  /// Throws if this map holds another key than these: to be used before any field is read, so that
  /// a misspelt key is named instead of the field that is missing because of it.
  void check_keys(std::initializer_list<const char*> known) const;
  /// Throws if this map holds a key that none of the functions above has read.
  void check_no_unknown_keys() const;

  /// "file:line: key = value" for messages, or "file:line: key" with this map's line if the key is
  /// absent.
  [[nodiscard]] std::string place(const std::string& key) const;

  /// For rules that involve several fields: throws "file:line: key = value, must be `allowed`".
  [[noreturn]] void fail(const std::string& key, const std::string& allowed) const;
  /// The same for this value itself.
  [[noreturn]] void fail(const std::string& allowed) const;

 private:
  struct File;  ///< name, format and tree of values
  Node(std::shared_ptr<const File> file, const Value& value, std::string path, int line);
  [[nodiscard]] static Node root_of(Value root, const std::string& name, FileFormat format);
  [[nodiscard]] std::optional<Node> find(const std::string& key) const;
  [[nodiscard]] Node child(const std::string& key, const std::string& allowed) const;
  [[noreturn]] void fail_at(int line, const std::string& text) const;
  [[nodiscard]] std::string shown_value() const;
  [[nodiscard]] std::string map_word() const;

  std::shared_ptr<const File> file_;
  const Value* value_;
  std::string path_;  ///< path from the top, empty there
  int line_;          ///< of an absent map, the line of the enclosing one
  std::shared_ptr<std::vector<std::string>> asked_;  ///< keys; shared by copies
};

}  // namespace hlc
