#pragma once

#include <yaml-cpp/yaml.h>

#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace hlc {

/// What a field may hold beside its type: a range for numbers, a choice of words for strings.
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

/// A map, list or value of a YAML file that knows where it stands, for strict reading: every field
/// has a type and a range, and a key that nobody asked for is an error.
///
///     const YamlNode file = YamlNode::read_file("car.yaml");
///     const auto length_m = file.required<double>("length_m", above(0.0));
///     const auto name = file.optional<std::string>("name", "car");
///     for (const YamlNode& wheel : file.list("wheels")) {
///       radii_m.push_back(wheel.required<double>("radius_m"));
///       wheel.check_no_unknown_keys();
///     }
///     file.check_no_unknown_keys();  // for every map, after its last field
///
/// All errors are std::invalid_argument with one line, "file:line: key = value, allowed ...". Keys
/// are printed with the way to them, list entries counted from 1: `trims[3].speed_mps`. Long values
/// are cut.
class YamlNode {
 public:
  /// @throws std::invalid_argument if the file is no regular file, cannot be read, is not YAML, or
  /// does not hold a map
  [[nodiscard]] static YamlNode read_file(const std::filesystem::path& path);
  /// The same for text in memory; `name` stands for the file in messages.
  [[nodiscard]] static YamlNode parse(const std::string& text, const std::string& name);

  [[nodiscard]] bool has(const std::string& key) const;

  /// True if the key is there and holds a single value, neither a map nor a list.
  [[nodiscard]] bool is_value(const std::string& key) const;

  /// True if the key is there and holds a list.
  [[nodiscard]] bool is_list(const std::string& key) const;

  /// Value of a key of this map. T: double (finite), int, std::size_t, bool, std::string.
  template <typename T>
  [[nodiscard]] T required(const std::string& key, const Allowed& allowed = {}) const;
  /// The same, `fallback` if the key is absent. `fallback` itself is not checked.
  template <typename T>
  [[nodiscard]] T optional(const std::string& key, T fallback, const Allowed& allowed = {}) const;

  /// A map inside this map.
  [[nodiscard]] YamlNode map(const std::string& key) const;
  /// The same; a map without keys if the key is absent.
  [[nodiscard]] YamlNode optional_map(const std::string& key) const;
  /// Entries of a list inside this map; may be empty.
  [[nodiscard]] std::vector<YamlNode> list(const std::string& key) const;
  /// The same; no entries if the key is absent.
  [[nodiscard]] std::vector<YamlNode> optional_list(const std::string& key) const;

  /// The keys of this map, in their order in the file.
  [[nodiscard]] std::vector<std::string> keys() const;

  /// True if this entry of a list is a map, a list.
  [[nodiscard]] bool is_map() const { return node_.IsMap(); }
  [[nodiscard]] bool is_list() const { return node_.IsSequence(); }
  /// Value of an entry of a list. T as for `required`.
  template <typename T>
  [[nodiscard]] T as(const Allowed& allowed = {}) const;
  /// Entries of an entry that is itself a list.
  [[nodiscard]] std::vector<YamlNode> entries() const;

  /// Throws if this map holds a key that none of the functions above was asked for.
  void check_no_unknown_keys() const;

  /// "file:line: key = value" for messages, or "file:line: key" with this map's line if the key is
  /// absent.
  [[nodiscard]] std::string place(const std::string& key) const;

  /// For rules that need more than one field: throws "file:line: key = value, allowed `allowed`".
  [[noreturn]] void fail(const std::string& key, const std::string& allowed) const;
  /// The same for this value itself.
  [[noreturn]] void fail(const std::string& allowed) const;

 private:
  YamlNode(const YAML::Node& node, std::string file, std::string path, int line);
  [[nodiscard]] std::optional<YamlNode> find(const std::string& key) const;
  [[nodiscard]] YamlNode child(const std::string& key, const std::string& allowed) const;
  [[noreturn]] void fail_at(int line, const std::string& text) const;
  [[nodiscard]] std::string path_of(const std::string& key) const;

  YAML::Node node_;
  std::string file_;
  std::string path_;  ///< way from the top, empty there
  int line_;
  std::shared_ptr<std::vector<std::string>> asked_;  ///< keys; shared by copies
};

}  // namespace hlc
