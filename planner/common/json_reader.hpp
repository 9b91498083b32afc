#pragma once

#include <filesystem>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hlc {

/// A value in a JSON file that knows where it stands, so that every error names file, place, value
/// and what is allowed in one line: "problem.json: start.psi = "north", allowed a finite number".
/// Points into the document that it was read from.
class JsonPlace {
 public:
  JsonPlace(const std::string& file, std::string place, const nlohmann::json& value)
      : file_(&file), place_(std::move(place)), value_(&value) {}

  /// @throws std::invalid_argument
  [[noreturn]] void fail(const std::string& allowed) const;
  /// The same with a reason instead of what is allowed: "problem.json: automaton = "a.yaml": ...".
  /// @throws std::invalid_argument
  [[noreturn]] void fail_because(const std::string& reason) const;

  /// @throws as fail if there is no such key, or this is no object
  [[nodiscard]] JsonPlace at(const std::string& key, const std::string& allowed) const;
  [[nodiscard]] std::optional<JsonPlace> find(const std::string& key) const;
  /// Of this object, sorted.
  [[nodiscard]] std::vector<std::string> keys() const;
  /// Refuses any key of this object that is not listed.
  void check_keys(std::initializer_list<std::string_view> known) const;

  /// @param size  that the list must have, if it must have one; `allowed` then says so
  [[nodiscard]] std::vector<JsonPlace> list(const std::string& allowed,
                                            std::optional<std::size_t> size = std::nullopt) const;
  [[nodiscard]] double number(double least, double most, const std::string& allowed) const;
  [[nodiscard]] double number() const;
  [[nodiscard]] std::size_t whole(std::size_t least, std::size_t most) const;
  [[nodiscard]] std::string text(const std::string& allowed) const;
  [[nodiscard]] bool truth() const;

 private:
  /// "problem.json: start.psi = "north"".
  [[nodiscard]] std::string shown() const;

  const std::string* file_;
  std::string place_;
  const nlohmann::json* value_;
};

/// @throws std::invalid_argument with one line naming the file, and line and column if it is no
/// JSON, the place of a number that no double holds, of a key that stands twice in an object or of
/// too many lists and objects within each other
[[nodiscard]] nlohmann::json read_json(const std::filesystem::path& path);

}  // namespace hlc
