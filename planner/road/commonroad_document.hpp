#pragma once

#include <tinyxml2.h>

#include <functional>
#include <string>
#include <string_view>

namespace hlc::road {

/// The elements of a CommonRoad file, 2020a or 2018b. All errors are std::runtime_error with one
/// line, `file:line: fault and bound`. Only sources of this folder include this file.
class CommonRoadDocument {
 public:
  /// @param name  of the file, for messages
  /// @throws std::runtime_error not XML, other root or version
  CommonRoadDocument(std::string_view xml, std::string name);

  [[nodiscard]] const tinyxml2::XMLElement& root() const { return *document_.RootElement(); }

  [[noreturn]] void fail(const tinyxml2::XMLElement& element, const std::string& what) const;
  /// Calls `visit` for all children of this name, in their order.
  static void for_each_child(const tinyxml2::XMLElement& element, const char* child_name,
                             const std::function<void(const tinyxml2::XMLElement&)>& visit);

  // Each throws if there is none, or no valid one.
  [[nodiscard]] std::string_view attribute(const tinyxml2::XMLElement& element,
                                           const char* attribute_name) const;
  /// A whole number from 1 to 2147483647.
  [[nodiscard]] int id_attribute(const tinyxml2::XMLElement& element,
                                 const char* attribute_name) const;
  [[nodiscard]] const tinyxml2::XMLElement& child(const tinyxml2::XMLElement& element,
                                                  const char* child_name) const;
  /// The finite number in a child.
  [[nodiscard]] double number(const tinyxml2::XMLElement& element, const char* child_name,
                              const char* unit) const;

  /// The value in quotes, without line breaks and cut, so that an error stays one line.
  [[nodiscard]] static std::string quoted(std::string_view value);

 private:
  [[noreturn]] void fail(int line, const std::string& what) const;

  std::string name_;
  tinyxml2::XMLDocument document_;
};

}  // namespace hlc::road
